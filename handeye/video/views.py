"""Camera views of a video, one for each frame."""

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
_FAR: Final = 0.95  # eye distance from the cell's middle, over the cell's size
_SWAY_DEG: Final = 34.0
_CLOSE, _WIDE = 0.42, 2.3
"""Distance from where the hand works: m, and m for each m of the hand's range."""
_AMID: Final = np.array([0.5, 0.5, -0.1])
"""Aim within the hand's range: below its middle, as the hand works low."""
_STILL_M: Final = 0.05
_GLIDE: Final = 0.9  # s between the views of two stages


def views(trace: Trace, camera: str, stages: Sequence[int], rate: float) -> list[View]:
    """The view of each frame; raises InvalidInput if there is no such camera.

    Args:
        camera: a camera of the scene, `orbit` or `follow`.
        stages: index of each frame's stage in `trace.stages_both_ways`, shape (n,).
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
    turns = _SWAY_DEG * (1 - np.cos(np.linspace(0, 2 * np.pi, frames))) / 2  # and back to where it was
    return [Near(camera=side, place=(x, y, z), distance=distance, turned=turned) for turned in turns.tolist()]


def _follow(trace: Trace, side: str, stages: Sequence[int], rate: float) -> list[View]:
    """Close to each stage's work, gliding from one to the next."""
    at = _smooth(np.array(_targets(trace))[np.maximum(stages, 0)], round(_GLIDE * rate))
    return [Near(camera=side, place=(x, y, z), distance=distance) for x, y, z, distance in at.tolist()]


def _targets(trace: Trace) -> list[Array]:
    """For each stage an aim (m) and viewing distance (m), shape (n, 4).

    A stage in which the hand stays takes those of the next stage, or the one before.
    """
    found = [_target(np.array(_hands(trace, stage))) for stage in trace.stages_both_ways]
    return [_nearest(found, number, trace) for number in range(max(len(found), 1))]


def _hands(trace: Trace, stage: Stage) -> list[tuple[float, float, float]]:
    """Hand positions after each step of a stage, m."""
    return [
        event.hand
        for event in trace.events
        if isinstance(event, StepFinished) and event.hand and stage.begin < event.time <= stage.end
    ]


def _target(hands: Array) -> Array | None:
    """Aim and distance for hand positions, shape (n, 3); None if they hardly differ."""
    if not len(hands) or np.ptp(hands, axis=0).max() < _STILL_M:
        return None
    low, size = hands.min(axis=0), np.ptp(hands, axis=0)
    return np.array([*low + _AMID * size, _CLOSE + _WIDE * np.linalg.norm(size) / 2])


def _nearest(found: Sequence[Array | None], number: int, trace: Trace) -> Array:
    for target in (*found[number:], *found[number::-1]):
        if target is not None:
            return target
    return np.array([*trace.scene.stat.center, _FAR * trace.scene.stat.extent])


def _smooth(values: Array, window: int) -> Array:
    """Smoothed values, shape as given (n, m)."""
    weights = np.hanning(2 * (window // 2) + 3)[1:-1]
    around = np.pad(values, ((window // 2,) * 2, (0, 0)), mode="edge")
    weights /= weights.sum()
    return np.stack([np.convolve(column, weights, mode="valid") for column in around.T], axis=1)
