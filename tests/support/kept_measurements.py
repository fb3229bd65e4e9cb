"""What the arm has measured of its joints before a program, once for each world in a process of tests.

Before a program that feels, the arm measures its friction and weighs its links, which takes 3.3 s of its time and
a quarter of the computing time of a short run. That depends on the world alone. A later run is put into the state
behind the measurement, as a run of the product is put behind a kept calibration.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps
from typing import TYPE_CHECKING, Final

from handeye.core.mutable_records import copied
from handeye.core.packed import encoded
from handeye.tasks import task

if TYPE_CHECKING:
    from handeye.cell.state import CellState
    from handeye.execution.state import DriveState
    from handeye.systems.stanford.executor_run import RunningPlan

RUN: Final = "handeye.systems.stanford.executor_run"
MOST: Final = 16
"""Worlds kept at a time."""

Measure = Callable[["RunningPlan"], float]


@dataclass(frozen=True)
class Measured:
    """A measurement: the cell before and after it, the drive after it, and the time that it took (s)."""

    before: CellState
    after: CellState
    drive: DriveState
    seconds: float


def keep_measurements() -> None:
    """Have joints measured once a world, if the tests that were collected run any plans in this process.

    `test_kept_measurements.py` shows that a run behind a kept measurement equals one that has measured.
    """
    run = sys.modules.get(RUN)
    if run is not None and not hasattr(run.RunningPlan._measure_joints, "__wrapped__"):
        run.RunningPlan._measure_joints = keeping(run.RunningPlan._measure_joints)


def keeping(measure: Measure) -> Measure:
    """The same, which measures in worlds that are not among the last ones, and where a test halts or replaces it."""
    kept: dict[bytes, Measured] = {}
    run = sys.modules[RUN]
    genuine = run.measure_joints

    @wraps(measure)
    def measured(self: RunningPlan) -> float:
        ours = type(task(self._setup.task)).__module__.startswith("handeye.")
        if not (ours and self.plan.program.feels and run.measure_joints is genuine):
            return measure(self)
        key = encoded((self._setup.task, self._setup.world, self._cell.renderer, self.state.drive))
        before, found = self._cell.capture(), kept.pop(key, None)
        if found is None or not before.equals(found.before) or self._halt():
            seconds = measure(self)
            found = Measured(before, self._cell.capture(), copied(self.state.drive), seconds)
        else:
            state = copied(self.state)
            state.drive = copied(found.drive)
            self._cell.restore(found.after)
            self.context.restore(state)
        if self.trouble is None:
            kept[key] = found
        if len(kept) > MOST:
            del kept[next(iter(kept))]
        return found.seconds

    return measured
