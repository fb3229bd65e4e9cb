"""Motions of the arm and the hand: what each operation does in the working phase."""

from typing import Final

import numpy as np

from handeye import errors
from handeye.arm.ik import IKResult
from handeye.arm.kinematics import forward
from handeye.arm.trajectory import Trajectory, four_three_four
from handeye.events import Adjusted, GuardTripped, Restored
from handeye.execution.compliance import Course
from handeye.execution.context import Action, ExecutionContext
from handeye.execution.servo_loop import Outcome
from handeye.execution.state import Fault, vector
from handeye.planning.motions import (
    Unreachable,
    change_samples,
    change_speed,
    directions,
    move_trajectory,
    turn_samples,
)
from handeye.pose import Array, Pose, translated
from handeye.program.causes import GapTooLarge, GapTooSmall, GuardsUnmet, NothingBetween, TravelOutside
from handeye.program.guards import Guards, unmet
from handeye.program.motion_operations import Center, Change, Close, Move, Open, Travel, Turn
from handeye.program.operation import Operation
from handeye.record import Vector3
from handeye.touch.centring import Centring
from handeye.touch.guards import monitor
from handeye.touch.hold import at_least, at_most

_SHUT: Final = -0.02
"""Set-point of the gap, m, that no thing and no hand reaches: the fingers press with all their grip."""
PLAN_TOLERANCE: Final = 1e-4
"""A goal or start nearer than this (m, rad) to its planned value is run as planned."""


def move(run: ExecutionContext, operation: Move) -> Fault | None:
    """Move to a position by its measured place, shifted by what was saved and by the search."""
    X_WT = run.world.position(operation.goal)
    run.state.restored = {}
    for restore in operation.restore:
        difference = run.state.saved.get(restore.name, np.zeros(3)).copy()
        if restore.level:
            difference[2] = 0.0
        X_WT = translated(X_WT, difference)
        run.state.restored[restore.name] = difference
        run.emit(
            Restored(time=run.time, name=restore.name, goal=operation.goal, difference=vector(difference))
        )  # fmt: skip
    run.state.goal = X_WT[:3, 3].copy()
    if operation.searching and run.state.search is not None:
        X_WT = translated(X_WT, (*run.state.search.offset(run.search), 0.0))
    via = [run.world.position(name) for name in operation.via]
    trajectory = _trajectory(run, operation, via, X_WT)
    if isinstance(trajectory, Unreachable):
        return Fault(number=errors.NO_SOLUTION, cause=trajectory.why.cause(run.arm, trajectory.name))
    samples = trajectory.sample(run.drive.period)
    along = directions(samples, run.arm, run.drive.state.q)
    return _finish(run, run.drive.follow(samples, monitor(operation.guards), along), operation.guards)


def _trajectory(
    run: ExecutionContext, operation: Move, via: list[Pose], X_WT: Pose
) -> Trajectory | Unreachable:
    """The planned trajectory if the world is where the plan thought, else one adjusted to it."""
    motion = run.planned
    knots = np.array(motion.knots)
    as_planned = np.abs(knots[0] - run.drive.state.q).max() < PLAN_TOLERANCE
    names, planned = (*operation.via, operation.goal), (*knots[2:-2], knots[-1])
    for name, X, q in zip(names, (*via, X_WT), planned, strict=True):
        off = X - forward(run.arm, q)
        if np.abs(off).max() >= PLAN_TOLERANCE:
            as_planned = False
            run.emit(Adjusted(time=run.time, goal=name, shift=vector(off[:3, 3])))
    if as_planned:
        return four_three_four(knots, np.array(motion.times))
    return move_trajectory(run.arm, run.drive.state.q, via, X_WT, operation, run.plan.speed)


def change(run: ExecutionContext, operation: Change) -> Fault | None:
    """Go straight from where the hand is, stopping on a force or torque, pressing if asked to."""
    start = run.drive.hand()[:3, 3]
    displacement = np.array(operation.displacement)
    distance = float(np.linalg.norm(displacement))
    guard = monitor(operation.guards)
    if not operation.complies:
        samples = change_samples(run.arm, run.drive.state.q, operation)
        if isinstance(samples, IKResult):
            return Fault(number=errors.NO_SOLUTION, cause=samples.cause(run.arm))
        outcome = run.drive.follow(samples, guard, displacement / distance)
    else:
        outcome = run.drive.comply(_course(run, operation), guard)
    run.state.travel = float((run.drive.hand()[:3, 3] - start) @ displacement) / distance
    return _finish(run, outcome, operation.guards)


def _course(run: ExecutionContext, operation: Change) -> Course:
    displacement = np.array(operation.displacement)
    distance = float(np.linalg.norm(displacement))
    return Course(
        compliance=run.arm.compliance,
        direction=displacement / distance,
        distance=distance,
        speed=change_speed(operation),
        force=None if operation.press is None else float(np.linalg.norm(operation.press)),
        free=_axes(operation.free),
        moment=np.zeros(3) if operation.moment is None else np.array(operation.moment),
        spin=_axes(operation.spin),
    )


def _axes(wanted: Vector3 | None) -> Array:
    """1 for each axis that is wanted, else 0."""
    return np.zeros(3) if wanted is None else (np.array(wanted) != 0).astype(float)


def turn(run: ExecutionContext, operation: Turn) -> Fault | None:
    """Go round the vertical through a position."""
    samples = turn_samples(run.arm, run.drive.state.q, run.world.position(operation.centre), operation)
    if isinstance(samples, IKResult):
        return Fault(number=errors.NO_SOLUTION, cause=samples.cause(run.arm))
    along = directions(samples, run.arm, run.drive.state.q)
    return _finish(run, run.drive.follow(samples, monitor(operation.guards), along), operation.guards)


def _finish(run: ExecutionContext, outcome: Outcome, guards: Guards) -> Fault | None:
    """Turn a motion's outcome into the language's convention: no trip where one was expected is an error."""
    if outcome.error is not None:
        return Fault(number=outcome.error, cause=outcome.cause)
    if outcome.trip is not None:
        trip = outcome.trip
        run.emit(
            GuardTripped(time=run.time, guard=trip.guard, value=round(trip.value, 6), limit=round(trip.limit, 6))
        )  # fmt: skip
        return None
    if not guards:
        return None
    return Fault(number=unmet(guards), cause=GuardsUnmet(guards=tuple(guard.kind for guard in guards)))


def open_hand(run: ExecutionContext, operation: Open) -> Fault | None:
    """Drive the fingers to a gap."""
    _to_gap(run, operation.gap)
    run.drive.hold(run.arm.hand.grasp.settle)
    return None


def _to_gap(run: ExecutionContext, goal: float) -> None:
    drive = run.drive
    start = drive.state.gap = drive.sensed.gap
    ticks = max(1, round(abs(goal - start) / (run.arm.hand.grasp.speed * drive.period)))
    for i in range(1, ticks + 1):
        drive.state.gap = start + (goal - start) * i / ticks
        drive.hold(1)


def close(run: ExecutionContext, operation: Close) -> Fault | None:
    """Close until both switches fire or the gap falls below the minimum, then see what is held."""
    drive, grasp = run.drive, run.arm.hand.grasp
    drive.state.gap = drive.sensed.gap
    floor = min(operation.minimum, drive.state.gap)
    while not all(drive.sensed.touch) and drive.sensed.gap > floor - 1e-4 and drive.state.gap > _SHUT:
        drive.state.gap -= grasp.speed * drive.period
        drive.hold(1)
    drive.state.gap = _SHUT
    drive.hold(grasp.settle)
    return _held(drive.sensed.gap, operation.minimum, operation.maximum)


def _held(gap: float, minimum: float, maximum: float | None) -> Fault | None:
    if not at_least(gap, minimum):
        return Fault(number=errors.NOTHING_HELD, cause=GapTooSmall(gap=round(gap, 6), minimum=minimum))
    if maximum is not None and not at_most(gap, maximum):
        return Fault(number=errors.WRONG_THICKNESS, cause=GapTooLarge(gap=round(gap, 6), maximum=maximum))
    return None


def center(run: ExecutionContext, operation: Center) -> Fault | None:
    """Close on an object, moving the arm so that the object stays where it is."""
    drive, grasp = run.drive, run.arm.hand.grasp
    X_WT = forward(run.arm, drive.state.q)
    line = X_WT[:3, 1]
    here = drive.dynamics()
    drive.state.gap = drive.sensed.gap
    centring = Centring(minimum=operation.minimum, speed=grasp.centring)
    while not centring.done:
        step = centring.step(touch=drive.sensed.touch, gap=drive.sensed.gap, period=drive.period)
        drive.state.gap += step.gap
        X_WT = translated(X_WT, step.hand * line)
        outcome = drive.shift(here, X_WT)
        if outcome.error is not None:
            return Fault(number=outcome.error, cause=outcome.cause)
    drive.hold(grasp.settle // 2)
    if centring.error:
        return Fault(number=centring.error, cause=NothingBetween(gap=round(drive.sensed.gap, 6)))
    run.state.finger_line = line
    return _held(drive.sensed.gap, operation.minimum, None)


def travel(run: ExecutionContext, operation: Travel) -> Fault | None:
    """See how far the last straight motion went."""
    if operation.minimum <= run.state.travel <= operation.maximum:
        return None
    gone = round(run.state.travel, 6)
    cause = TravelOutside(travel=gone, minimum=operation.minimum, maximum=operation.maximum)
    return Fault(number=errors.WRONG_TRAVEL, cause=cause)


MOTION_ACTIONS: Final[dict[type[Operation], Action]] = {
    Move: move,
    Change: change,
    Turn: turn,
    Open: open_hand,
    Close: close,
    Center: center,
    Travel: travel,
}
