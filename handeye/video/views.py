"""Where a video is taken from: one view for each of its frames."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from handeye.cell.photograph import Near
from handeye.core.errors import NoSuchName
from handeye.core.pose import Array
from handeye.program.events import StepFinished
from handeye.trace.stages import Stage
from handeye.trace.trace import Trace
from handeye.video.wanted import FOLLOW, ORBIT

View = str | Near
_FAR: Final = 0.95
"""How far the eye is from the middle of the cell, over the size of the cell."""
_SWAY: Final = 34.0
"""degrees"""
_CLOSE, _WIDE = 0.42, 2.3
"""How near the eye goes to where the hand works: m, and m for each m that the hand is from the middle of its places."""
_AMID: Final = np.array([0.5, 0.5, -0.1])
"""Where the eye looks amid these places: below their middle, for the hand works where it is low."""
_STAYS: Final = 0.05
"""m"""
_GLIDE: Final = 0.9
"""s that the eye takes from one stage to the next."""


def views(trace: Trace, camera: str, stages: Sequence[int], rate: float) -> list[View]:
    """The view of each frame; raises InvalidInput if there is no such camera.

    Args:
        camera: a camera of the scene, `orbit` or `follow`.
        stages: which stage each frame is of, by its number in `trace.stages_both_ways`; shape (n,).
        rate: frames a second.
    """
    cameras = [trace.scene.camera(number).name for number in range(trace.scene.ncam)]
    if camera == ORBIT:
        return list(_orbit(trace.scene, trace.overview, len(stages)))
    if camera == FOLLOW:
        return list(_follow(trace, trace.overview, stages, rate))
    if camera not in cameras:
        raise NoSuchName(f"no camera {camera}; there are {', '.join([ORBIT, FOLLOW, *cameras])}")
    return [camera] * len(stages)


def _orbit(scene: Any, side: str, frames: int) -> list[View]:
    (x, y, z), distance = scene.stat.center.tolist(), _FAR * float(scene.stat.extent)
    turns = _SWAY * (1 - np.cos(np.linspace(0, 2 * np.pi, frames))) / 2  # and back to where it was
    return [Near(camera=side, place=(x, y, z), distance=distance, turned=turned) for turned in turns.tolist()]


def _follow(trace: Trace, side: str, stages: Sequence[int], rate: float) -> list[View]:
    """Near to the places of each stage, gliding from one to the next."""
    at = _smooth(np.array(_targets(trace))[np.maximum(stages, 0)], round(_GLIDE * rate))
    return [Near(camera=side, place=(x, y, z), distance=distance) for x, y, z, distance in at.tolist()]


def _targets(trace: Trace) -> list[Array]:
    """For each stage a point amid the places of its hand (m), and from how far they are all seen (m); shape (n, 4).

    Where the hand stays where it is, it is what the next stage shows, or the one before.
    """
    found = [_target(np.array(_hands(trace, stage))) for stage in trace.stages_both_ways]
    return [_nearest(found, number, trace) for number in range(max(len(found), 1))]


def _hands(trace: Trace, stage: Stage) -> list[tuple[float, float, float]]:
    """Where the hand was after each step of a stage, m."""
    return [
        event.hand
        for event in trace.events
        if isinstance(event, StepFinished) and event.hand and stage.begin < event.time <= stage.end
    ]


def _target(hands: Array) -> Array | None:
    """What shows some places of the hand, shape (n, 3); None: they are hardly more than one."""
    if not len(hands) or np.ptp(hands, axis=0).max() < _STAYS:
        return None
    low, size = hands.min(axis=0), np.ptp(hands, axis=0)
    return np.array([*low + _AMID * size, _CLOSE + _WIDE * np.linalg.norm(size) / 2])


def _nearest(found: Sequence[Array | None], number: int, trace: Trace) -> Array:
    for target in (*found[number:], *found[number::-1]):
        if target is not None:
            return target
    return np.array([*trace.scene.stat.center, _FAR * trace.scene.stat.extent])


def _smooth(values: Array, window: int) -> Array:
    """Values that change slowly instead of by leaps, shape as given (n, m)."""
    weights = np.hanning(2 * (window // 2) + 3)[1:-1]
    around = np.pad(values, ((window // 2,) * 2, (0, 0)), mode="edge")
    weights /= weights.sum()
    return np.stack([np.convolve(column, weights, mode="valid") for column in around.T], axis=1)
