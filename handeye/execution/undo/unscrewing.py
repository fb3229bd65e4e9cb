"""Turning a screw out: left, with the hand following it as it rises, until the torque is gone."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.core.pose import Array
from handeye.execution.compliance import Course
from handeye.execution.context import ExecutionContext
from handeye.execution.servo_loop import Outcome
from handeye.execution.undo.done import Done
from handeye.execution.undo.resistance import Resistance, allowed
from handeye.execution.undo.way import Way
from handeye.program.guards import GuardKind
from handeye.touch.guards import ActiveGuard, FirstOf, Reading, Trip

SPEED: Final = 1.5
"""Times as fast as the screw was driven in: a motor that stalls at its speed's torque has to give the loosening one."""
PRESS: Final = 6.0
"""N on the screw, so that the bit stays in its slot: what it was driven in with."""
TURN: Final = 0.00127 * 1.5
"""m: a turn and a half of the thread. By so much less may the hand rise than it went down: its start is not felt."""
QUIET: Final = 20
"""Servo periods in which the hand must not have risen any more: in as many a thread lifts a screw by 3 mm."""
RISING: Final = 2e-4
"""m of height that count as risen."""
PATIENCE: Final = 120
"""Servo periods in which a screw must have begun to rise."""


LOWER: Final = 0.002
"""m that the hand goes down at most, in a second, to see whether a screw stands under the bit. Half the height of its
head: without it, the bit meets nothing there."""


@dataclass(slots=True, kw_only=True)
class Loosened:
    """Trips when the screw is out, or does not come: the hand rises no more."""

    height: Callable[[], float]
    """Of the hand, m."""
    rise: float
    """By how much it rises at least when the screw is out, m."""
    before: float
    """By how much it had risen before turning was broken off, m."""
    highest: float = field(init=False)
    started: float = field(init=False)
    torque: float = 0.0
    """Greatest that the driver has shown, N m."""
    _quiet: int = 0
    _periods: int = 0

    def __post_init__(self) -> None:
        self.highest = self.height()
        self.started = self.highest - self.before

    @property
    def risen(self) -> float:
        """By how much the hand has risen, m."""
        return self.highest - self.started

    @property
    def out(self) -> bool:
        """The screw is out."""
        return self.risen >= self.rise

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        """Its guard."""
        return (ActiveGuard(guard=GuardKind.TORQUE, limit=0.0),)

    def check(self, reading: Reading) -> Trip | None:
        """The trip, or None."""
        height, self._periods = self.height(), self._periods + 1
        self.torque = max(self.torque, abs(reading.tool_torque))
        rising = height > self.highest + RISING
        self._quiet = 0 if rising else self._quiet + 1
        self.highest = height if rising else self.highest
        over = self._quiet >= QUIET and (self.out or self._periods >= PATIENCE)
        return Trip(guard=GuardKind.TORQUE, value=abs(reading.tool_torque), limit=0.0) if over else None


def unscrew(run: ExecutionContext, done: Done, way: Way) -> tuple[Outcome, Loosened]:
    """Turn left on the screw that a step has driven in, until it is out or does not come.

    Returns:
        What else ended it, if anything did, and how far the screw came.
    """
    drive = run.drive
    begin, end = forward(run.arm, way.q[[0, -1]])[:, 2, 3]
    rise = max(float(begin - end) - TURN, RISING)
    loosened = Loosened(height=lambda: float(drive.hand()[2, 3]), rise=rise, before=done.risen)
    drive.state.tool, drive.state.current = -SPEED * done.tool, 0.0
    guards = FirstOf(monitors=(Resistance(limit=allowed(done.force)), loosened))
    outcome = drive.comply(_course(run), guards)
    drive.state.tool = 0.0
    drive.hold(run.arm.servo.settle)
    return outcome, loosened


def lower(run: ExecutionContext, force: float) -> Outcome:
    """Go down a little, until a force (N) bears the hand, giving way to the side; no trip: nothing does."""
    course = replace(_course(run), distance=LOWER, speed=LOWER, force=None)
    return run.drive.comply(course, Resistance(limit=force))


def _course(run: ExecutionContext) -> Course:
    """Pressing on the screw, and giving way to it upwards and to the side."""
    return Course(
        compliance=run.arm.compliance,
        direction=np.array((0.0, 0.0, -1.0)),
        distance=1.0,
        speed=run.arm.compliance.speed,
        force=PRESS,
        free=np.array((1.0, 1.0, 0.0)),
        friction=np.abs(run.felt_friction).sum(axis=1),
    )


def taken_by(run: ExecutionContext, backwards: Iterable[int]) -> int | None:
    """The index of the step that took the screw which a step drives in: it ended on its head, before the hand moved.

    Args:
        backwards: indices of the steps from the driving one on, the last first.

    Returns:
        None: there is none.
    """
    done, moved = run.state.done, False
    for index in backwards:
        operation = run.plan.program.steps[done[index].step].operation
        moved = moved or operation.goal_position is not None
        if moved and done[index].ended is GuardKind.FORCE:
            return index
    return None
