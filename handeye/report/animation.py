"""The 3D animation of a recorded run, as data for the player."""

from dataclasses import dataclass

from handeye.report.player import scene_bytes, tracks_bytes
from handeye.report.recorded import RecordedRun


@dataclass(frozen=True, slots=True, kw_only=True)
class Animation:
    """Scene and tracks for the player, compressed."""

    scene: bytes
    tracks: bytes


def animation(run: RecordedRun) -> Animation | None:
    """The animation of a run; None if nothing was recorded between its events."""
    if not len(run.trace.times):
        return None
    return Animation(scene=scene_bytes(run.trace), tracks=tracks_bytes(run.trace))
