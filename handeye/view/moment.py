"""A moment of a run: what those who look on are shown of the cell, copied so that nothing can be changed by it."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.execution.servo_period import ServoPeriod
from handeye.program.events import AnyEvent, beginning
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.trace.frames import Frames, NoFrames
from handeye.trace.messages import Poses
from handeye.view.television import NEWS, television

FIGURES: Final = 5
"""Figures before the joints: time, gap, and the three of the force."""


@dataclass(frozen=True, eq=False)
class Moment:
    """The cell at the end of a servo period."""

    time: float
    """s since the run began."""
    gap: float
    """Between the fingers, m."""
    force: Array | None
    """Of the hand on the world, shape (3,), N; None: it is not estimated."""
    joints: Array
    """Shape (n,), rad and m."""
    poses: Poses
    """Of all bodies of the cell, shape (m, 7): place (m), quaternion w, x, y, z; NaN: not there."""

    @cached_property
    def packed(self) -> bytes:
        """The moment as 32-bit numbers, little-endian: `FIGURES`, joints, poses; NaN: not estimated."""
        force = np.full(3, np.nan) if self.force is None else self.force
        numbers = (np.array([self.time, self.gap]), force, self.joints, self.poses.ravel())
        return np.concatenate(numbers).astype("<f4").tobytes()


class Newest(Observer):
    """Keeps the newest moment and picture of a run, for whoever may come and look; they are read from any thread."""

    def __init__(self, runner: Runner) -> None:
        self._begun: float | None = None
        self.follow(runner)

    def follow(self, runner: Runner) -> None:
        """Look on at a runner from now on; one that goes on in the cell of another goes on with its time, too."""
        cell = runner.system.cell
        self.frames = NoFrames() if cell is None else Frames(cell.truth, runner.system.joints)
        self._runner = runner
        self._joints: Array = np.full(len(self.frames.joints), np.nan)
        self._gap = np.nan
        self.moment = self._now(None)
        self.television = television(runner)

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, NEWS):
            self._look()

    def tick(self, period: ServoPeriod) -> None:
        sensed = period.sensed
        self._joints, self._gap = np.array(sensed.q), float(sensed.gap)
        self.moment = self._now(None if period.wrench is None else np.array(period.wrench[:3]))

    def undone(self, events: int) -> None:
        self.moment = self._now(None)
        self._look()

    def _look(self) -> None:
        """See what the television shows; where that is as before, it stays the same value, which is sent once."""
        seen = television(self._runner)
        if seen.shows != self.television.shows:
            self.television = seen

    def _now(self, force: Array | None) -> Moment:
        poses = self.frames.poses()
        poses[~self.frames.there()] = np.nan
        return Moment(time=self._elapsed(), gap=self._gap, force=force, joints=self._joints, poses=poses)

    def _elapsed(self) -> float:
        """s since the first of the runs began."""
        if self._begun is None and self._runner.events:
            self._begun = beginning(self._runner.events)
        return 0.0 if self._begun is None else round(self._runner.time - self._begun, 6)
