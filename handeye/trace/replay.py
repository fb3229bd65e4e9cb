"""Replay of a recorded run at any time, without simulating it again: for views and reports."""

from bisect import bisect_right
from dataclasses import dataclass, field

import numpy as np

from handeye.errors import InvalidInput
from handeye.events import StageFinished, StageStarted, StepStarted
from handeye.pose import Array
from handeye.trace.messages import Poses
from handeye.trace.trace import Pose7, TakenPicture, Trace


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class State:
    """A moment of a run."""

    time: float
    """Of the servo period that is shown, s."""
    joints: Array
    """Positions by the sensors, shape (n,), rad and m."""
    gap: float
    """m"""
    poses: dict[str, Pose7]
    """Frames in W: place (m), then a unit quaternion w, x, y, z."""
    stage: str | None
    """None between two stages."""
    step: StepStarted | None
    """The step under way, or done last: its line and text."""
    picture: TakenPicture | None
    """The last one taken."""


@dataclass(slots=True)
class _Telling:
    """Stage and step from a time on."""

    time: float
    stage: str | None
    step: StepStarted | None


@dataclass(slots=True)
class Replay:
    """A trace made ready to be looked at from any time to any other.

    Raises:
        InvalidInput: nothing was recorded between its events.
    """

    trace: Trace
    times: list[float] = field(init=False)
    """Of the servo periods, s."""
    names: tuple[str, ...] = field(init=False)
    """Of the frames."""
    _joints: Array = field(init=False)
    _gaps: list[float] = field(init=False)
    _poses: Poses = field(init=False)  # shape (periods, frames, 7); NaN before a frame is first seen
    _told: list[_Telling] = field(init=False)
    _pictures: list[TakenPicture] = field(init=False)

    def __post_init__(self) -> None:
        ticks = list(self.trace.ticks())
        if not ticks:
            raise InvalidInput(f"{self.trace.name} holds no motion to be shown")
        self.times = [tick.time for tick in ticks]
        self.names = tuple(dict.fromkeys(name for tick in ticks for name in tick.moved))
        self._joints = np.array([tick.q for tick in ticks])
        self._gaps = [tick.gap for tick in ticks]
        self._poses = np.full((len(ticks), len(self.names), 7), np.nan, dtype=np.float32)
        index = {name: number for number, name in enumerate(self.names)}
        for row, tick in enumerate(ticks):
            self._poses[row] = self._poses[row - 1] if row else np.nan
            for name, pose in tick.moved.items():
                self._poses[row, index[name]] = pose
        self._told = _tellings(self.trace)
        self._pictures = list(self.trace.pictures())

    def seek(self, time: float) -> State:
        """State at a time (s); before the first servo period as at the first, after the last as at the last."""
        row = max(bisect_right(self.times, time) - 1, 0)
        here = self._poses[row]
        told = bisect_right(self._told, time, key=lambda telling: telling.time) - 1
        taken = bisect_right(self._pictures, time, key=lambda picture: picture.time) - 1
        return State(
            time=self.times[row],
            joints=self._joints[row],
            gap=self._gaps[row],
            poses={
                name: _pose(pose)
                for name, pose in zip(self.names, here, strict=True)
                if not np.isnan(pose[0])
            },
            stage=self._told[told].stage if told >= 0 else None,
            step=self._told[told].step if told >= 0 else None,
            picture=self._pictures[taken] if taken >= 0 else None,
        )


def _pose(row: Poses) -> Pose7:
    x, y, z, qw, qx, qy, qz = row.tolist()
    return x, y, z, qw, qx, qy, qz


def _tellings(trace: Trace) -> list[_Telling]:
    told: list[_Telling] = []
    stage: str | None = None
    step: StepStarted | None = None
    for event in trace.events:
        if isinstance(event, StageStarted):
            stage = event.stage
        elif isinstance(event, StageFinished):
            stage = None
        elif isinstance(event, StepStarted):
            step = event
        else:
            continue
        told.append(_Telling(event.time, stage, step))
    return told
