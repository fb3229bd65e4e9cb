"""Reverses executed steps, beginning with the last one. The operation of a step determines how the step is reversed."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from msgspec.structs import replace

from handeye.arm.kinematics import forward
from handeye.core import errors
from handeye.core.errors import Refused
from handeye.core.pose import Array
from handeye.execution.context import ExecutionContext
from handeye.execution.servo_loop import Outcome
from handeye.execution.state import ExecutedStep, ExecutionState, ReversalOrder, vector
from handeye.execution.undo.loops import loop_entry, touch_entry, without_rounds
from handeye.execution.undo.memory import Memory, recalled, remember
from handeye.execution.undo.retracing import (
    EarlyContact,
    Resistance,
    allowed,
    retracing,
    stands,
    where_the_hand_is,
)
from handeye.execution.undo.unscrewing import LOWER, TIGHTENED, descent, lower, taken_by, unscrew
from handeye.execution.undo.way import RecordedPath, packed, unpacked
from handeye.planning.motions import Unreachable, directions, move_trajectory
from handeye.program.diagnosis.causes import (
    BackingOut,
    Cause,
    HoldOff,
    ScrewFast,
    ScrewLost,
    UndoResisted,
    UndoUnknown,
)
from handeye.program.events import GuardTripped, StageUndone, UndoEnded, UndoFinished, UndoStarted
from handeye.program.guards import GuardKind
from handeye.program.motion_operations import Center, Close, Move, Open
from handeye.program.operation import Operation
from handeye.touch.guards import FirstOf, Monitor
from handeye.touch.senses import EMPTY_GAP, SAME_HOLD, SKEW, as_before, at_least

SUPPORT_SHARE: Final = 0.5
"""Before the hand lets go of a returned screw, the hand presses the screw down to check that the screw stands in its
place. This constant is the force of the press, as a fraction of the force with which the hand took the screw.
"""
STRAIGHTER: Final = 2 * 1.1e-3
"""Greatest change (m) of the gap when a carried object turns until it lies flat against the fingers. Our choice: twice
the largest measured value.
"""
SAME_JOINTS: Final = 1e-4  # rad or m within which an arm is at a loop's entry


@dataclass(frozen=True, slots=True, kw_only=True)
class UndoFailure:
    """Why a reversal was interrupted. An interrupted reversal stops the run."""

    error: int | None = None
    cause: Cause | None = None


def order(state: ExecutionState, undoing: ReversalOrder) -> None:
    """Order a reversal. Raises Refused if there are no steps to reverse."""
    if undoing.left >= len(state.done):
        raise Refused("there is nothing to undo")
    if not state.grasping:
        state.held = None
    elif state.held is None:
        state.held = state.done[-1].gap[1]
    state.undoing, state.stopped, state.onward, state.idle = undoing, None, None, 0
    state.pending, state.at = None, state.done[-1].step


def end(state: ExecutionState) -> None:
    """End a reversal. If the reversal switched the magnet off to put a screw down, the magnet is switched on again."""
    state.undoing, state.drive.magnet = None, True


def undo_last(run: ExecutionContext) -> UndoFailure | None:
    """Reverse the last executed step. If one lift of the hand reverses several of the last steps, reverse all of these
    steps. Remove the reversed steps from the list of executed steps.

    Returns None, or the reason why the reversal stopped. If the reversal stopped, the last step is only partly
    reversed.
    """
    state = run.state
    first = _first_of_lift(run)
    here = state.done[-1].step
    run.drive.track.begin(run.drive.state.q, run.drive.state.gap)
    step, count = run.plan.program.steps[here], len(state.done) - first
    run.emit(
        UndoStarted(time=run.time, step=here, file=step.file, line=step.line, text=step.text, steps=count)
    )
    state.stage = step.stage
    try:
        several = first < len(state.done) - 1
        remembered = [recalled(run, done.remembered) for done in state.done[first:]]
        stopped = _lift(run, first - 1) if several else _undo(run, state.done[-1])
        undone = [] if stopped else _forget(run, first, remembered)
    except ValueError:  # a path or a memory that does not fit this program and its arm
        stopped, undone = UndoFailure(cause=UndoUnknown()), []
    hand, gap = vector(run.drive.hand()[:3, 3]), round(run.drive.sensed.gap, 6)
    force = round(run.drive.track.force, 3)
    run.emit(UndoFinished(time=run.time, step=here, hand=hand, planned=None, gap=gap, force=force))
    if undone:
        _proceed(run, undone)
    return stopped


def _first_of_lift(run: ExecutionContext) -> int:
    """Return the index of the first step that is reversed together with the last step."""
    state = run.state
    assert state.undoing is not None
    last = len(state.done) - 1
    try:
        rounds = loop_entry(state.done, lambda index: _hand_behind(run, index), grasping=state.grasping)
    except ValueError:  # a path that cannot be used does not show a round
        return last
    entry = touch_entry(state.done, grasping=state.grasping) if rounds is None else rounds
    return last if entry is None or entry + 1 < state.undoing.left else entry + 1


def _forget(run: ExecutionContext, first: int, remembered: Sequence[Memory]) -> list[ExecutedStep]:
    """Restore the memory to its state before the step at index `first`. Removes this step and all later steps from the
    executed steps, and returns them.

    `remembered` holds, for each of these steps, the old values of the variables that the step changed.
    """
    state, undone = run.state, run.state.done[first:]
    for memory in reversed(remembered):
        remember(state, memory)
    state.drive.load, state.drive.tool = undone[0].load, 0.0
    state.drive.in_air = state.drive.clear = False
    if state.lets_go is not None and state.lets_go >= first:
        state.lets_go = None
    del state.done[first:]
    return undone


def _proceed(run: ExecutionContext, undone: list[ExecutedStep]) -> None:
    """Report the new place in the program, and set the next step."""
    state = run.state
    assert state.undoing is not None
    assert state.stage is not None
    if any(done.enters for done in undone):
        run.emit(StageUndone(time=run.time, stage=run.plan.program.stages[state.stage]))
        state.stage = None
    state.at = state.done[-1].step if len(state.done) > state.undoing.left else None
    if state.at is None:
        onward, halts = undone[0].step, state.undoing.halts
        run.emit(UndoEnded(time=run.time, step=onward))
        end(state)
        state.at, state.onward = None if halts else onward, onward if halts else None


# -- by operation -------------------------------------------------------------------------------------


def _undo(run: ExecutionContext, done: ExecutedStep) -> UndoFailure | None:
    operation = run.plan.program.steps[done.step].operation
    drive = run.drive.state
    if not done.way:
        return None
    if run.state.lets_go == len(run.state.done) - 1 and drive.magnet:
        # before the magnet lets go, the screw must stand where a step took it
        outcome = lower(run, force := SUPPORT_SHARE * done.force)
        if outcome.error is not None:
            return UndoFailure(error=outcome.error, cause=outcome.cause)
        if outcome.trip is None:
            return UndoFailure(cause=ScrewLost(way=LOWER, force=round(force, 6)))
        drive.magnet = False
    if done.tool:
        return _turn_out(run, done)
    stopped = _UNDOING.get(type(operation), _retrace)(run, done)
    if operation.goal_position is not None and stopped is None:
        drive.magnet = True  # the hand has left the screw
    return stopped


def _way(run: ExecutionContext, done: ExecutedStep) -> RecordedPath:
    return unpacked(done.way, len(run.arm.joints))


def _retrace(run: ExecutionContext, done: ExecutedStep) -> UndoFailure | None:
    """Retrace the path of a step while the hand keeps holding its object."""
    way = _way(run, done)
    stopped = _go(run, done, RecordedPath(q=way.q, gap=np.full(len(way), run.drive.state.gap)))
    resisted = stopped is not None and isinstance(stopped.cause, UndoResisted)
    steps = run.plan.program.steps

    def grasps(earlier: ExecutedStep) -> bool:
        return _UNDOING.get(type(steps[earlier.step].operation)) is _let_go

    return None if resisted and stands(run, way, grasps) else stopped


def _let_go(run: ExecutionContext, done: ExecutedStep) -> UndoFailure | None:
    """Reverse a grasp: open the fingers to the earlier gap. If the step only changed the grip on an object that the
    fingers already held, they grip it again as firmly as before the step.

    Before opening, the fingers must hold the object that they grasped, so the gap must be the same as in that grasp.
    If the reversal has grasped the object again, the gap must be the same as in the later grasp. A carried object may
    straighten between the fingers: in the world of seed 1, a base that straightened changed the gap by 1.1 mm. A
    change of more than twice this amount means another object, or no object.
    """
    kept = done.gap[1]
    held = kept if run.state.held is None else run.state.held
    most = STRAIGHTER if at_least(min(held, kept), EMPTY_GAP) else 0.0
    straighter = min(max(held - kept, -most), most)
    off = _off_hold(run, kept, SKEW + max(-straighter, 0.0), SAME_HOLD + max(straighter, 0.0))
    if off is not None:
        return off
    done = replace(done, way=packed(where_the_hand_is(run, _way(run, done))))
    if not done.grasping:
        stopped = _fingers_back(run, done)
        run.state.held = run.state.held if stopped else None
        return stopped
    stopped = _retrace(run, done)
    if stopped is None:
        _press(run, done.fingers)
    return stopped


def _take_again(run: ExecutionContext, done: ExecutedStep) -> UndoFailure | None:
    """Reverse an opening: close the fingers on the object that they held before the step."""
    stopped = _fingers_back(run, done)
    if stopped is None and done.grasping:
        run.state.held = run.drive.sensed.gap
    return stopped


def _fingers_back(run: ExecutionContext, done: ExecutedStep) -> UndoFailure | None:
    # the returned object may press with the force that ended the motion before the step
    before = next((earlier for earlier in reversed(run.state.done[:-1]) if earlier.way), done)
    meeting = None
    if "touch" not in run.without:
        meeting = EarlyContact(gap=lambda: run.drive.sensed.gap, kept=done.gap[0], holding=done.grasping)
    stopped = _go(run, replace(done, force=max(done.force, before.force)), _way(run, done), meeting)
    if stopped is not None:
        return stopped
    _press(run, done.fingers)
    off = SKEW if done.grasping else SAME_HOLD
    return _off_hold(run, done.gap[0], off, off, holding=done.grasping)


def _press(run: ExecutionContext, gap: float) -> None:
    """Set the gap (m) and let the fingers settle."""
    run.drive.state.gap = gap
    run.drive.hold(run.arm.hand.grasp.settle)


def _turn_out(run: ExecutionContext, done: ExecutedStep) -> UndoFailure | None:
    """Reverse a step in which the screwdriver was on: turn out the screw that the step drove home. The screw then hangs
    from the bit.

    If the step only tightened a screw that was already driven, the screw stays in.
    """
    if done.tool < 0:
        return UndoFailure(cause=BackingOut())
    way = _way(run, done)
    if done.ended is not GuardKind.TORQUE or descent(run, way) < TIGHTENED:
        return _retrace(run, done)
    outcome, screw = unscrew(run, done, way)
    turned = outcome.trip is not None and outcome.trip.guard is GuardKind.TORQUE
    if not (turned and screw.out):
        risen = round(screw.risen, 6)
        run.state.done[-1] = replace(done, risen=risen)
        fast = UndoFailure(cause=ScrewFast(torque=round(screw.torque, 6), risen=risen))
        return fast if turned else _met(run, outcome) or fast
    backwards = without_rounds(run.state.done, lambda index: _hand_behind(run, index))
    run.state.lets_go = taken_by(run, backwards)
    return None


def _off_hold(
    run: ExecutionContext, kept: float, closer: float, wider: float, *, holding: bool = True
) -> UndoFailure | None:
    """Check that the present gap is close to `kept`, the gap of the executed step (m). The present gap may be smaller
    by `closer` (m) at most, or larger by `wider` (m) at most.
    """
    gap = run.drive.sensed.gap
    if as_before(gap, kept, closer, wider):
        return None
    return UndoFailure(cause=HoldOff(gap=round(gap, 6), kept=kept, holding=holding))


_UNDOING: Final[dict[type[Operation], Callable[[ExecutionContext, ExecutedStep], UndoFailure | None]]] = {
    Open: _take_again,
    Close: _let_go,
    Center: _let_go,
}
"""Method of reversal for each operation that needs its own method. All other motions retrace their set-points, and
steps without motion only restore memory.
"""


# -- moving -------------------------------------------------------------------------------------------


def _go(
    run: ExecutionContext, done: ExecutedStep, way: RecordedPath, meeting: EarlyContact | None = None
) -> UndoFailure | None:
    """Retrace a path under guards. If a guard stops the arm, the rest of the path remains to be reversed."""
    drive = run.drive
    back = retracing(
        run.arm, drive.state.q, drive.state.gap, way, slowly=done.force > 0, feeling=meeting is not None
    )
    reached = -1

    def beside(number: int) -> None:
        nonlocal reached
        reached, drive.state.gap = number, float(back.gap[number])

    along = directions(back.samples, run.arm, drive.state.q)
    resistance = Resistance(limit=allowed(done.force))
    guard: Monitor = resistance if meeting is None else FirstOf(monitors=(resistance, meeting))
    outcome = drive.follow(back.samples, guard, along, beside)
    stopped = _met(run, outcome, meeting)
    if stopped is not None and reached >= 0:
        left = slice(0, int(back.left[reached]) + 1)
        rest = packed(RecordedPath(q=way.q[left], gap=way.gap[left]))
        run.state.done[-1] = replace(done, way=rest, gap=(done.gap[0], round(drive.sensed.gap, 6)))
    return stopped


def _lift(run: ExecutionContext, entry: int) -> UndoFailure | None:
    """Move the hand up, across and down, as a MOVE does, to the position that it had after the step with index
    `entry`.
    """
    q = _joints_behind(run, entry)
    if q is None or np.abs(q - run.drive.state.q).max() < SAME_JOINTS:
        return None
    X_WT, operation = forward(run.arm, q), Move(goal="")
    trajectory = move_trajectory(run.arm, run.drive.state.q, [], X_WT, operation, run.plan.speed)
    if isinstance(trajectory, Unreachable):
        return UndoFailure(error=errors.NO_SOLUTION, cause=trajectory.why.cause(run.arm))
    samples = trajectory.sample(run.drive.period)
    along = directions(samples, run.arm, run.drive.state.q)
    return _met(run, run.drive.follow(samples, Resistance(limit=allowed(0.0)), along))


def _met(run: ExecutionContext, outcome: Outcome, meeting: EarlyContact | None = None) -> UndoFailure | None:
    """Return the failure if a motion of the reversal failed, or None if the reversal can go on."""
    if outcome.error is not None:
        return UndoFailure(error=outcome.error, cause=outcome.cause)
    if outcome.trip is None:
        return None
    value, limit = round(outcome.trip.value, 6), round(outcome.trip.limit, 6)
    run.emit(GuardTripped(time=run.time, guard=outcome.trip.guard, value=value, limit=limit))
    if meeting is not None and outcome.trip.guard is GuardKind.TOUCH:
        return UndoFailure(cause=meeting.cause(outcome.trip))
    return UndoFailure(cause=UndoResisted(force=value, limit=limit))


def _joints_behind(run: ExecutionContext, index: int) -> Array | None:
    """Return the set-point of the arm after a step, shape (n,), or None if the arm had not moved yet."""
    moved = next((done for done in reversed(run.state.done[: index + 1]) if done.way), None)
    if moved is not None:
        return np.asarray(_way(run, moved).q[-1])
    later = next((done for done in run.state.done[index + 1 :] if done.way), None)
    return None if later is None else np.asarray(_way(run, later).q[0])


def _hand_behind(run: ExecutionContext, index: int) -> Array | None:
    q = _joints_behind(run, index)
    return None if q is None else np.asarray(forward(run.arm, q)[:3, 3])
