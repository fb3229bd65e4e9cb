"""Prepares the 3D animation of a recorded run as data for the player."""

from dataclasses import dataclass

from handeye.report.player import scene_bytes, tracks_bytes
from handeye.report.recorded import RecordedRun


@dataclass(frozen=True, slots=True, kw_only=True)
class Animation:
    """Compressed data for the player: the scene of a run, and the tracks of the bodies in the scene."""

    scene: bytes
    tracks: bytes


def animation(run: RecordedRun) -> Animation | None:
    """Return the animation of a run, or None if the trace contains no motion."""
    if not len(run.trace.times):
        return None
    return Animation(scene=scene_bytes(run.trace), tracks=tracks_bytes(run.trace))
