"""Actions that move the arm."""

import math
from statistics import median
from typing import Final

import numpy as np
from msgspec import structs

from handeye.arm.friction import faint
from handeye.arm.ik import IKResult
from handeye.arm.kinematics import forward
from handeye.arm.trajectory import Trajectory, four_three_four
from handeye.core import errors
from handeye.core.pose import Array, Pose, translated
from handeye.core.record import Vector3
from handeye.execution.compliance import Course
from handeye.execution.context import Action, ExecutionContext
from handeye.execution.servo_loop import REACHED, Outcome
from handeye.execution.state import DriveState, Fault, vector
from handeye.planning.motions import (
    Unreachable,
    change_samples,
    change_speed,
    directions,
    move_trajectory,
    turn_samples,
)
from handeye.program.diagnosis.causes import (
    GuardsUnmet,
    HandAstray,
    HeightOutside,
    HeightUnknown,
    JointBehind,
    TravelOutside,
)
from handeye.program.diagnosis.sense_causes import (
    CurrentShort,
    CurrentSilent,
    CurrentUnlike,
    MotorFast,
    MotorSlow,
    ScrewHard,
)
from handeye.program.events import Adjusted, GuardFaint, GuardTripped, Restored
from handeye.program.guards import GuardKind, Guards, Torque, unmet
from handeye.program.motion_operations import Change, Height, Move, Travel, Turn
from handeye.program.operation import Operation
from handeye.touch.guards import monitor
from handeye.touch.senses import (
    CURRENT_NOISE,
    DRIVEN,
    FAST_PERIODS,
    HELD_FAST,
    PLATEAU,
    STALLED_TORQUE,
    STARTING_PERIODS,
    STARTING_TORQUE,
    WIND_UP,
)

PLAN_TOLERANCE: Final = 1e-4  # a goal or start within this (m, rad) of its planned value is run as planned


def move(run: ExecutionContext, operation: Move) -> Fault | None:
    """Move to a position at its measured place, shifted by saved differences and by the offset of the search."""
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
    run.state.goal, run.state.place = X_WT[:3, 3].copy(), operation.goal
    if operation.searching and run.state.search is not None:
        X_WT = translated(X_WT, (*run.state.search.offset(run.search), 0.0))
        run.state.search.around = operation.goal
    via = [run.world.position(name) for name in operation.via]
    trajectory = _trajectory(run, operation, via, X_WT)
    if isinstance(trajectory, Unreachable):
        return Fault(number=errors.NO_SOLUTION, cause=trajectory.why.cause(run.arm, trajectory.name))
    samples = trajectory.sample(run.drive.period)
    along = directions(samples, run.arm, run.drive.state.q)
    guards = run.watching(operation.guards)
    _report_faint(run, guards, along[0])
    lift_off = trajectory.lift_off(run.drive.period)
    return _finish(run, run.drive.glide(samples, monitor(guards), along, lift_off=lift_off), guards)


def _trajectory(
    run: ExecutionContext, operation: Move, via: list[Pose], X_WT: Pose
) -> Trajectory | Unreachable:
    """Return the planned trajectory if the arm starts as planned and all poses are as planned. Return an adjusted
    trajectory if not. If a pose is out of reach, return the reason why.
    """
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
    """Move straight from the present place. Guards on force or torque can end the motion. If the operation asks for
    it, the hand presses during the motion.
    """
    start = run.drive.hand()[:3, 3]
    displacement = np.array(operation.displacement)
    distance = float(np.linalg.norm(displacement))
    guards = run.watching(operation.guards)
    guard = monitor(guards)
    _report_faint(run, guards, displacement)
    if not operation.complies or "force" in run.without:
        samples = change_samples(run.arm, run.drive.state.q, operation)
        if isinstance(samples, IKResult):
            return Fault(number=errors.NO_SOLUTION, cause=samples.cause(run.arm))
        outcome = run.drive.follow(samples, guard, displacement / distance)
    else:
        outcome = run.drive.comply(_course(run, operation), guard)
    run.state.travel = float((run.drive.hand()[:3, 3] - start) @ displacement) / distance
    run.drive.state.in_air = False
    run.drive.state.clear = outcome == REACHED and not (operation.guards or operation.complies)
    failed = _finish(run, outcome, guards) or _turned_hard(run, guards)
    stood = distance - run.state.travel > run.arm.servo.short
    if failed is not None and failed.number == errors.NO_TORQUE and stood:
        return _held_fast(run, guards) or failed
    return failed


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
        friction=np.abs(run.felt_friction).sum(axis=1),
    )


def _axes(wanted: Vector3 | None) -> Array:
    """Return 1 for each wanted axis and 0 for the others."""
    return np.zeros(3) if wanted is None else (np.array(wanted) != 0).astype(float)


def turn(run: ExecutionContext, operation: Turn) -> Fault | None:
    """Turn about a vertical axis through a position."""
    samples = turn_samples(run.arm, run.drive.state.q, run.world.position(operation.centre), operation)
    if isinstance(samples, IKResult):
        return Fault(number=errors.NO_SOLUTION, cause=samples.cause(run.arm))
    if len(samples.q) == 0:
        return None
    along = directions(samples, run.arm, run.drive.state.q)
    guards = run.watching(operation.guards)
    _report_faint(run, guards, along[0])
    outcome = run.drive.follow(samples, monitor(guards), along)
    run.drive.state.in_air = run.drive.state.clear = False
    return _finish(run, outcome, guards)


def _report_faint(run: ExecutionContext, guards: Guards, along: Array) -> None:
    """Report each guard whose limit is so low that friction could trip it. The guards of a statement are reported only
    once. The motion begins in direction `along`, shape (3,), in W.
    """
    assert run.state.at is not None
    place = run.plan.program.steps[run.state.at].place
    if not guards or place in run.state.faint:
        return
    drive = run.drive.state
    for guard in guards:
        waited = guard.exerted(vector(along) if along.any() else None)
        most = None if waited is None else faint(run.arm, drive.q, drive.friction, waited)
        if waited is not None and most is not None:
            limit = round(math.hypot(*waited.vector), 6)
            run.emit(GuardFaint(time=run.time, guard=guard.kind, limit=limit, friction=round(most, 6)))
            run.state.faint = [*run.state.faint, place]


def _finish(run: ExecutionContext, outcome: Outcome, guards: Guards) -> Fault | None:
    """Return the error of a motion, or None if the motion has no error. It is an error if the motion has guards and
    none of them tripped.
    """
    if outcome.error is not None:
        cause = outcome.cause
        if isinstance(cause, HandAstray | JointBehind):
            cause = structs.replace(cause, of=run.part_here)
        return Fault(number=outcome.error, cause=cause)
    if outcome.trip is not None:
        trip = outcome.trip
        run.emit(
            GuardTripped(time=run.time, guard=trip.guard, value=round(trip.value, 6), limit=round(trip.limit, 6))
        )  # fmt: skip
    kinds = tuple(guard.kind for guard in guards)
    if GuardKind.TORQUE in kinds and run.drive.state.tool:
        doubted = _motor(run)
        if doubted is not None:
            return Fault(number=errors.CURRENT_WRONG, cause=doubted)
    if outcome.trip is not None or not guards:
        return None
    return Fault(number=unmet(guards), cause=GuardsUnmet(guards=kinds))


def _motor(run: ExecutionContext) -> CurrentSilent | CurrentUnlike | MotorSlow | MotorFast | None:
    """Compare the torque of the screwdriver's motor, measured by its current, with two known torques: the starting
    torque, and the torque of the clutch.

    A motor that starts against a resistance takes more torque than usual, but not more than its clutch transmits. No
    sound motor takes less torque than usual.
    """
    drive, least = run.drive.state, STARTING_TORQUE - 4 * CURRENT_NOISE / math.sqrt(STARTING_PERIODS)
    if drive.current > STALLED_TORQUE + 5 * CURRENT_NOISE:
        return CurrentUnlike(torque=round(drive.current, 6), known=STALLED_TORQUE)
    if len(drive.starting) < STARTING_PERIODS:
        return None
    first, mean = drive.starting[0], sum(drive.starting[:STARTING_PERIODS]) / STARTING_PERIODS
    if mean >= least:
        return _fast(drive)
    if drive.current < 2 * CURRENT_NOISE:
        return CurrentSilent(torque=round(drive.current, 6))
    if first >= least:
        return MotorSlow(share=round(mean / STARTING_TORQUE, 3))
    return CurrentUnlike(torque=round(mean, 6), known=STARTING_TORQUE)


def _fast(drive: DriveState) -> MotorFast | None:
    """Return the cause if the motor turns too fast; if not, return None. A motor whose free speed is too high needs
    longer than usual to reach this speed, because the speed is higher. When the motor has reached it, the motor runs
    without load.
    """
    late, free = drive.starting[STARTING_PERIODS:], drive.lately[FAST_PERIODS:]
    if len(late) < FAST_PERIODS - STARTING_PERIODS or not free or median(free) > 2 * CURRENT_NOISE:
        return None
    late_starts = min(late) >= STARTING_TORQUE - 2.5 * CURRENT_NOISE
    return MotorFast(times=FAST_PERIODS / STARTING_PERIODS) if late_starts else None


def _turned_hard(run: ExecutionContext, guards: Guards) -> Fault | None:
    """Return the error if a screw was too hard to turn before the torque reached the limit of the guard. The thread of
    such a screw uses up torque that should clamp the parts.
    """
    asked = [each.torque for each in guards if isinstance(each, Torque)]
    running = run.drive.state.lately[: -round(WIND_UP / run.drive.period)]
    if not asked or not running or run.state.travel < DRIVEN or not run.drive.state.tool:
        return None
    shown, limit = median(running), HELD_FAST * min(asked)
    if shown <= limit:
        return None
    cause = ScrewHard(torque=round(shown, 6), limit=round(limit, 6))
    return Fault(number=errors.CURRENT_WRONG, cause=cause)


def _held_fast(run: ExecutionContext, guards: Guards) -> Fault | None:
    """Return the error if the motor is held fast: its torque during the last second is high, but below the torque of
    the guard.

    No thread and no slipping bit takes this much torque for a whole second. If something holds the motor fast, the
    motor's torque rises until the clutch slips.
    """
    lately, asked = run.drive.state.lately, min(each.torque for each in guards if isinstance(each, Torque))
    enough = len(lately) >= round(PLATEAU / run.drive.period) and asked <= STALLED_TORQUE
    if not enough or min(lately) < HELD_FAST * asked:
        return None
    shown = round(sum(lately) / len(lately), 6)
    return Fault(number=errors.CURRENT_WRONG, cause=CurrentShort(torque=shown, asked=asked))


def travel(run: ExecutionContext, operation: Travel) -> Fault | None:
    """Check the length of the last straight motion."""
    if operation.minimum <= run.state.travel <= operation.maximum:
        return None
    gone = round(run.state.travel, 6)
    cause = TravelOutside(travel=gone, minimum=operation.minimum, maximum=operation.maximum)
    return Fault(number=errors.WRONG_TRAVEL, cause=cause)


def height(run: ExecutionContext, operation: Height) -> Fault | None:
    """Compare the hand's height with its height at the SAVE that the operation names. Returns an error if the
    difference is outside the limits of the operation.
    """
    saved = run.state.heights.get(operation.name)
    if saved is None:
        return Fault(number=errors.WRONG_HEIGHT, cause=HeightUnknown(name=operation.name))
    over = run.drive.height - saved
    if operation.minimum <= over <= operation.maximum:
        return None
    cause = HeightOutside(
        name=operation.name, height=round(over, 6), minimum=operation.minimum, maximum=operation.maximum
    )
    return Fault(number=errors.WRONG_HEIGHT, cause=cause)


MOTION_ACTIONS: Final[dict[type[Operation], Action]] = {
    Move: move,
    Change: change,
    Turn: turn,
    Travel: travel,
    Height: height,
}
