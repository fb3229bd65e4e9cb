"""Turns a screw out: the motor turns left, and the hand follows the screw upwards until the torque is gone."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.core.pose import Array
from handeye.execution.compliance import Course
from handeye.execution.context import ExecutionContext
from handeye.execution.servo_loop import Outcome
from handeye.execution.state import ExecutedStep
from handeye.execution.undo.retracing import Resistance, allowed
from handeye.execution.undo.way import RecordedPath
from handeye.program.guards import GuardKind
from handeye.touch.guards import ActiveGuard, FirstOf, Reading, Trip

SPEED: Final = 1.5
"""Speed of turning out, as a multiple of the speed of driving in. The torque at which a motor stalls is proportional
to its commanded speed. At this higher speed, the motor exerts enough torque to loosen a screw.
"""
PRESS: Final = 6.0  # N on the screw to keep the bit in its slot, as for driving in
TURN: Final = 0.00127 * 1.5
"""A screw may rise by up to this distance (m) less than it went down: one and a half turns of the thread. This
tolerance is needed because the start of the thread is not sensed.
"""
TIGHTENED: Final = 3 * 0.00127
"""Height (m) of three turns of the thread. A screw that rises by less than this height was only tightened. A screw
driven from the mouth of its thread makes five turns.
"""
QUIET: Final = 20  # servo periods without rising that show the end; a thread would lift a screw by 3 mm
RISING: Final = 2e-4  # m that count as risen
PATIENCE: Final = 120  # servo periods within which a screw must begin to rise


LOWER: Final = 0.002
"""The bit descends by at most this distance (m), within one second, to check that there is a screw under it. The
distance is half the height of the screw's head.
"""


@dataclass(slots=True, kw_only=True)
class ScrewMonitor:
    """Trips when the screw is out, or when it does not rise."""

    height: Callable[[], float]  # of the hand, in m
    rise: float  # least rise of a screw that is out, in m
    before: float  # rise before an interruption, in m
    highest: float = field(init=False)
    started: float = field(init=False)
    torque: float = 0.0  # greatest so far, in N m
    _quiet: int = 0
    _periods: int = 0

    def __post_init__(self) -> None:
        self.highest = self.height()
        self.started = self.highest - self.before

    @property
    def risen(self) -> float:
        """Rise of the hand since the start (m)."""
        return self.highest - self.started

    @property
    def out(self) -> bool:
        """True if the screw is out."""
        return self.risen >= self.rise

    def active(self, direction: Array) -> tuple[ActiveGuard, ...]:
        return (ActiveGuard(guard=GuardKind.TORQUE, limit=0.0),)

    def check(self, reading: Reading) -> Trip | None:
        height, self._periods = self.height(), self._periods + 1
        self.torque = max(self.torque, abs(reading.tool_torque))
        rising = height > self.highest + RISING
        self._quiet = 0 if rising else self._quiet + 1
        self.highest = height if rising else self.highest
        over = self._quiet >= QUIET and (self.out or self._periods >= PATIENCE)
        return Trip(guard=GuardKind.TORQUE, value=abs(reading.tool_torque), limit=0.0) if over else None


def descent(run: ExecutionContext, way: RecordedPath) -> float:
    """Return the descent (m) of the hand along a path."""
    begin, end = forward(run.arm, way.q[[0, -1]])[:, 2, 3]
    return float(begin - end)


def unscrew(run: ExecutionContext, done: ExecutedStep, way: RecordedPath) -> tuple[Outcome, ScrewMonitor]:
    """Turn out the screw that a step drove in, until the screw is out or stops rising.

    Returns the outcome of the motion, and the monitor of the screw.
    """
    drive = run.drive
    rise = max(descent(run, way) - TURN, RISING)
    loosened = ScrewMonitor(height=lambda: float(drive.hand()[2, 3]), rise=rise, before=done.risen)
    drive.state.tool, drive.state.current = -SPEED * done.tool, 0.0
    guards = FirstOf(monitors=(Resistance(limit=allowed(done.force)), loosened))
    outcome = drive.comply(_course(run), guards)
    drive.state.tool = 0.0
    drive.hold(run.arm.servo.settle)
    return outcome, loosened


def lower(run: ExecutionContext, force: float) -> Outcome:
    """Lower the hand a little, yielding sideways, until a force (N) supports it. If the hand finds no support, `trip`
    of the outcome is None.
    """
    course = replace(_course(run), distance=LOWER, speed=LOWER, force=None)
    return run.drive.comply(course, Resistance(limit=force))


def _course(run: ExecutionContext) -> Course:
    """Return the course of the hand: press on the screw, and yield upwards and sideways."""
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
    """Return the index of the step in which the screwdriver took up the screw that a later step drives in. In that
    step, the force of the screw's head on the screwdriver ended the motion of the hand. If several steps before the
    move to the hole ended like this, the last of them is returned. Returns None if there is no such step.

    `backwards` gives the indices of steps, from the driving step backwards.
    """
    done, moved = run.state.done, False
    for index in backwards:
        operation = run.plan.program.steps[done[index].step].operation
        moved = moved or operation.goal_position is not None
        if moved and done[index].ended is GuardKind.FORCE:
            return index
    return None
