"""Undoing executed steps, the last one first: how each operation is undone, and what stops it."""

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
from handeye.execution.state import ExecutionState, vector
from handeye.execution.undo.done import Done, Undoing
from handeye.execution.undo.loops import loop_entry, touch_entry, without_rounds
from handeye.execution.undo.meeting import Meeting
from handeye.execution.undo.memory import Memory, recalled, remember
from handeye.execution.undo.resistance import Resistance, allowed
from handeye.execution.undo.retracing import retracing
from handeye.execution.undo.standing import stands, where_the_hand_is
from handeye.execution.undo.unscrewing import LOWER, lower, taken_by, unscrew
from handeye.execution.undo.way import Way, packed, unpacked
from handeye.planning.motions import Unreachable, directions, move_trajectory
from handeye.program.causes import BackingOut, Cause, HoldOff, ScrewFast, ScrewLost, UndoResisted, UndoUnknown
from handeye.program.events import GuardTripped, StageUndone, UndoEnded, UndoFinished, UndoStarted
from handeye.program.guards import GuardKind
from handeye.program.motion_operations import Center, Close, Move, Open
from handeye.program.operation import Operation
from handeye.touch.guards import FirstOf, Monitor
from handeye.touch.hold import EMPTY_GAP, SAME_HOLD, SKEW, as_before, at_least

STANDS: Final = 0.5
"""Of the force with which a screw was taken: so much has to bear the hand that brings it back."""
STRAIGHTER: Final = 2 * 1.1e-3
"""m by which what is carried may come to lie straighter in the fingers. Chosen: twice the most measured."""
BESIDE: Final = 1e-4
"""rad or m: an arm that is no farther from where a loop was entered is there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stopped:
    """Why an undo was broken off: the run stays where it is."""

    error: int | None = None
    cause: Cause | None = None


def order(state: ExecutionState, undoing: Undoing) -> None:
    """From now on each step undoes one, the last first.

    Raises:
        InvalidInput: no more is left than what is to be left.
    """
    if undoing.left >= len(state.done):
        raise Refused("there is nothing to undo")
    if not state.grasping:
        state.held = None
    elif state.held is None:
        state.held = state.done[-1].gap[1]
    state.undoing, state.stopped, state.onward, state.idle = undoing, None, None, 0
    state.pending, state.at = None, state.done[-1].step


def end(state: ExecutionState) -> None:
    """No more is undone: a program that goes on finds the magnet on, as it left it."""
    state.undoing, state.drive.magnet = None, True


def undo_last(run: ExecutionContext) -> Stopped | None:
    """Undo the step that was executed last, or with it those that a lift undoes; what is undone is taken off the list.

    Returns:
        None, or what stopped it: then the last step is as far undone as it came.
    """
    state = run.state
    first = _first_of_lift(run)
    here = state.done[-1].step
    state.stage = run.plan.program.steps[here].stage
    run.drive.track.begin(run.drive.state.q, run.drive.state.gap)
    _tell(run, here, len(state.done) - first)
    try:
        several = first < len(state.done) - 1
        remembered = [recalled(run, done.remembered) for done in state.done[first:]]
        stopped = _lift(run, first - 1) if several else _undo(run, state.done[-1])
        undone = [] if stopped else _forget(run, first, remembered)
    except ValueError:  # a way or a memory that is none of this program and its arm
        stopped, undone = Stopped(cause=UndoUnknown()), []
    run.emit(_finished(run, here))
    if undone:
        _come_to(run, undone)
    return stopped


def _first_of_lift(run: ExecutionContext) -> int:
    """The index of the first step that is undone with the last one."""
    state = run.state
    assert state.undoing is not None
    last = len(state.done) - 1
    try:
        rounds = loop_entry(state.done, lambda index: _hand_behind(run, index), grasping=state.grasping)
    except ValueError:  # a way that cannot be used tells of no round
        return last
    entry = touch_entry(state.done, grasping=state.grasping) if rounds is None else rounds
    return last if entry is None or entry + 1 < state.undoing.left else entry + 1


def _tell(run: ExecutionContext, number: int, steps: int) -> None:
    step = run.plan.program.steps[number]
    run.emit(
        UndoStarted(time=run.time, step=number, file=step.file, line=step.line, text=step.text, steps=steps)
    )


def _finished(run: ExecutionContext, number: int) -> UndoFinished:
    """The account of a step that is undone."""
    hand, gap = vector(run.drive.hand()[:3, 3]), round(run.drive.sensed.gap, 6)
    force = round(run.drive.track.force, 3)
    return UndoFinished(time=run.time, step=number, hand=hand, planned=None, gap=gap, force=force)


def _forget(run: ExecutionContext, first: int, remembered: Sequence[Memory]) -> list[Done]:
    """Remember what the program did before the step of an index; all from there on, taken off the list.

    Args:
        remembered: before each of these steps, as far as it changed that.
    """
    state, undone = run.state, run.state.done[first:]
    for memory in reversed(remembered):
        remember(state, memory)
    state.drive.load, state.drive.tool, state.drive.in_air = undone[0].load, 0.0, False
    if state.lets_go is not None and state.lets_go >= first:
        state.lets_go = None
    del state.done[first:]
    return undone


def _come_to(run: ExecutionContext, undone: list[Done]) -> None:
    """Tell where the run stands now, and what is next."""
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


def _undo(run: ExecutionContext, done: Done) -> Stopped | None:
    operation = run.plan.program.steps[done.step].operation
    drive = run.drive.state
    if not done.way:
        return None
    if run.state.lets_go == len(run.state.done) - 1 and drive.magnet:
        lost = _screw_lost(run, done)
        if lost is not None:
            return lost
        drive.magnet = False
    if done.tool:
        return _turn_out(run, done)
    stopped = _UNDOING.get(type(operation), _retrace)(run, done)
    if operation.goal_position is not None and stopped is None:
        drive.magnet = True  # it is away from what it let go
    return stopped


def _way(run: ExecutionContext, done: Done) -> Way:
    return unpacked(done.way, len(run.arm.joints))


def _retrace(run: ExecutionContext, done: Done) -> Stopped | None:
    """Go the way of a step back, with what the hand holds."""
    way = _way(run, done)
    stopped = _go(run, done, Way(q=way.q, gap=np.full(len(way), run.drive.state.gap)))
    resisted = stopped is not None and isinstance(stopped.cause, UndoResisted)
    return None if resisted and stands(run, way, lambda earlier: _grasps(run, earlier)) else stopped


def _let_go(run: ExecutionContext, done: Done) -> Stopped | None:
    """Undo a grasp: the fingers open to where they were; what they held already they hold as firmly as before."""
    off = _lost(run, done.gap[1])
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


def _take_again(run: ExecutionContext, done: Done) -> Stopped | None:
    """Undo an opening: the fingers close to where they were, on what they held there."""
    stopped = _fingers_back(run, done)
    if stopped is None and done.grasping:
        run.state.held = run.drive.sensed.gap
    return stopped


def _fingers_back(run: ExecutionContext, done: Done) -> Stopped | None:
    stopped = _go(run, replace(done, force=_under(run, done)), _way(run, done), _meeting(run, done))
    if stopped is not None:
        return stopped
    _press(run, done.fingers)
    off = SKEW if done.grasping else SAME_HOLD
    return _off_hold(run, done.gap[0], off, off, holding=done.grasping)


def _meeting(run: ExecutionContext, done: Done) -> Meeting | None:
    """What sees that fingers meet nothing before they are where they were; None: nothing tells that they touch."""
    if "touch" in run.without:
        return None
    return Meeting(gap=lambda: run.drive.sensed.gap, kept=done.gap[0], holding=done.grasping)


def _under(run: ExecutionContext, done: Done) -> float:
    """The force that fingers bring back with what they held, N: that with which the motion before had ended."""
    before = next((earlier for earlier in reversed(run.state.done[:-1]) if earlier.way), done)
    return max(done.force, before.force)


def _press(run: ExecutionContext, gap: float) -> None:
    """Give the fingers a set-point, m, and time to come to rest."""
    run.drive.state.gap = gap
    run.drive.hold(run.arm.hand.grasp.settle)


def _turn_out(run: ExecutionContext, done: Done) -> Stopped | None:
    """Undo a step in which the driver turned: a screw that it has driven home is turned out, and hangs from its bit."""
    if done.tool < 0:
        return Stopped(cause=BackingOut())
    if done.ended is not GuardKind.TORQUE:
        return _retrace(run, done)
    outcome, screw = unscrew(run, done, _way(run, done))
    turned = outcome.trip is not None and outcome.trip.guard is GuardKind.TORQUE
    if not (turned and screw.out):
        risen = round(screw.risen, 6)
        run.state.done[-1] = replace(done, risen=risen)
        fast = Stopped(cause=ScrewFast(torque=round(screw.torque, 6), risen=risen))
        return fast if turned else _met(run, outcome) or fast
    backwards = without_rounds(run.state.done, lambda index: _hand_behind(run, index))
    run.state.lets_go = taken_by(run, backwards)
    return None


def _screw_lost(run: ExecutionContext, done: Done) -> Stopped | None:
    """See that the screw stands where a step has taken it, before the magnet lets go of it."""
    force = STANDS * done.force
    outcome = lower(run, force)
    if outcome.error is not None or outcome.trip is not None:
        return None if outcome.error is None else Stopped(error=outcome.error, cause=outcome.cause)
    return Stopped(cause=ScrewLost(way=LOWER, force=round(force, 6)))


def _lost(run: ExecutionContext, kept: float) -> Stopped | None:
    """See that the fingers hold what they took: where they stood when it was grasped, or since it was taken again.

    What is carried may come to lie straighter between them: one base of seed 1, by 1.1 mm. What is more than twice as
    much thicker or thinner is another thing, and so is nothing.
    """
    held = kept if run.state.held is None else run.state.held
    most = STRAIGHTER if at_least(min(held, kept), EMPTY_GAP) else 0.0
    straighter = min(max(held - kept, -most), most)
    return _off_hold(run, kept, SKEW + max(-straighter, 0.0), SAME_HOLD + max(straighter, 0.0))


def _off_hold(
    run: ExecutionContext, kept: float, closer: float, wider: float, *, holding: bool = True
) -> Stopped | None:
    """See that the fingers stand where they stood when the step was executed, or closer or wider by no more (m)."""
    gap = run.drive.sensed.gap
    if as_before(gap, kept, closer, wider):
        return None
    return Stopped(cause=HoldOff(gap=round(gap, 6), kept=kept, holding=holding))


_UNDOING: Final[dict[type[Operation], Callable[[ExecutionContext, Done], Stopped | None]]] = {
    Open: _take_again,
    Close: _let_go,
    Center: _let_go,
}
"""How operations are undone. Other motions go the same set-points the other way; where nothing moved, only what the
program remembers is as it was."""


def _grasps(run: ExecutionContext, done: Done) -> bool:
    return _UNDOING.get(type(run.plan.program.steps[done.step].operation)) is _let_go


# -- moving -------------------------------------------------------------------------------------------


def _go(run: ExecutionContext, done: Done, way: Way, meeting: Meeting | None = None) -> Stopped | None:
    """Go a way back, guarded; where that is broken off, what is left of it stays to be undone."""
    drive = run.drive
    back = retracing(run.arm, drive.state.q, drive.state.gap, way, slowly=done.force > 0)
    come = -1

    def beside(number: int) -> None:
        nonlocal come
        come, drive.state.gap = number, float(back.gap[number])

    along = directions(back.samples, run.arm, drive.state.q)
    resistance = Resistance(limit=allowed(done.force))
    guard: Monitor = resistance if meeting is None else FirstOf(monitors=(resistance, meeting))
    outcome = drive.follow(back.samples, guard, along, beside)
    stopped = _met(run, outcome, meeting)
    if stopped is not None and come >= 0:
        left = slice(0, int(back.left[come]) + 1)
        rest = packed(Way(q=way.q[left], gap=way.gap[left]))
        run.state.done[-1] = replace(done, way=rest, gap=(done.gap[0], round(drive.sensed.gap, 6)))
    return stopped


def _lift(run: ExecutionContext, entry: int) -> Stopped | None:
    """Go to where the hand was when the step of an index was done: up, across and down, as a MOVE goes."""
    q = _joints_behind(run, entry)
    if q is None or np.abs(q - run.drive.state.q).max() < BESIDE:
        return None
    X_WT, operation = forward(run.arm, q), Move(goal="")
    trajectory = move_trajectory(run.arm, run.drive.state.q, [], X_WT, operation, run.plan.speed)
    if isinstance(trajectory, Unreachable):
        return Stopped(error=errors.NO_SOLUTION, cause=trajectory.why.cause(run.arm))
    samples = trajectory.sample(run.drive.period)
    along = directions(samples, run.arm, run.drive.state.q)
    return _met(run, run.drive.follow(samples, Resistance(limit=allowed(0.0)), along))


def _met(run: ExecutionContext, outcome: Outcome, meeting: Meeting | None = None) -> Stopped | None:
    """What a motion met that ends the undo."""
    if outcome.error is not None:
        return Stopped(error=outcome.error, cause=outcome.cause)
    if outcome.trip is None:
        return None
    value, limit = round(outcome.trip.value, 6), round(outcome.trip.limit, 6)
    run.emit(GuardTripped(time=run.time, guard=outcome.trip.guard, value=value, limit=limit))
    if meeting is not None and outcome.trip.guard is GuardKind.TOUCH:
        return Stopped(cause=meeting.cause(outcome.trip))
    return Stopped(cause=UndoResisted(force=value, limit=limit))


def _joints_behind(run: ExecutionContext, index: int) -> Array | None:
    """Set-point of the arm when the step of an index was done, shape (n,); None: it has not moved yet."""
    moved = next((done for done in reversed(run.state.done[: index + 1]) if done.way), None)
    if moved is not None:
        return np.asarray(_way(run, moved).q[-1])
    later = next((done for done in run.state.done[index + 1 :] if done.way), None)
    return None if later is None else np.asarray(_way(run, later).q[0])


def _hand_behind(run: ExecutionContext, index: int) -> Array | None:
    q = _joints_behind(run, index)
    return None if q is None else np.asarray(forward(run.arm, q)[:3, 3])
