"""Actions that do not move the arm. These actions test for errors, change counters, control searches, save
differences, define positions, declare the load, and set the screwdriver.
"""

from typing import Final

from handeye.core import errors
from handeye.execution.context import Action, Decision, ExecutionContext
from handeye.execution.state import Fault, SearchState, vector
from handeye.program.diagnosis.causes import NoSearch, PlacesTried
from handeye.program.events import ErrorTested, HandTold, PositionDefined, Saved, SearchAdvanced
from handeye.program.flow_operations import (
    Advance,
    Assign,
    Countdown,
    Here,
    Jump,
    Load,
    Save,
    Search,
    Test,
    Tool,
    Undo,
    Wait,
    Where,
)
from handeye.program.operation import Operation
from handeye.program.senses import TESTED
from handeye.program.world_model import rounded_place


def test_error(run: ExecutionContext, operation: Test) -> bool:
    """Test whether the last action raised a certain error, and clear this error. Returns True if the error was
    raised.
    """
    pending = run.state.pending
    occurred = pending is not None and pending.number == operation.number
    if TESTED.get(operation.number) in run.without:
        # The sense that would find the error is switched off. Assume that the error occurred if only the branch
        # for its absence leads to the operator or to a retry.
        assert run.state.at is not None
        unless = run.plan.program.steps[run.state.at].next
        occurred = not _gives_up(run, operation.raised) and _gives_up(run, unless)
    run.emit(ErrorTested(time=run.time, number=operation.number, occurred=occurred))
    if occurred:
        run.state.pending = None
    return occurred


def _gives_up(run: ExecutionContext, number: int | None) -> bool:
    if number is None:
        return False
    operation = run.plan.program.steps[number].operation
    counted = operation.branch is not None and operation.branch.counter is not None
    return operation.calls is not None or errors.SEARCH_EXHAUSTED in operation.raising or counted


def assign(run: ExecutionContext, operation: Assign) -> None:
    """Set a counter."""
    run.state.counters[operation.counter] = operation.value


def count_down(run: ExecutionContext, operation: Countdown) -> bool:
    """Decrement a counter. Returns True if the counter is still positive."""
    left = run.state.counters[operation.counter] = run.state.counters.get(operation.counter, 0) - 1
    return left > 0


def search(run: ExecutionContext, operation: Search) -> None:
    """Start a search. The present place becomes the first place of the search."""
    run.state.search = SearchState(step=operation.step, limit=operation.limit, along=operation.along)


def advance(run: ExecutionContext, _: Advance) -> Fault | None:
    """Advance the search to its next place. The next motion of the search goes there."""
    state = run.state.search
    if state is None:
        return Fault(number=errors.SEARCH_EXHAUSTED, cause=NoSearch())
    following = None if "search" in run.without else state.place(run.search, state.count + 1)
    if following is None:
        return Fault(
            number=errors.SEARCH_EXHAUSTED, cause=PlacesTried(places=state.count + 1, around=state.around)
        )
    state.count += 1
    x, y = following
    run.emit(SearchAdvanced(time=run.time, count=state.count, offset=(round(x, 6), round(y, 6))))
    return None


def save(run: ExecutionContext, operation: Save) -> None:
    """Save the difference between the present position of the hand and the goal of the last Move. After a Center, only
    the component of the difference along the finger line is saved.
    """
    difference = run.drive.hand()[:3, 3] - run.state.goal
    if operation.name in run.state.restored:  # the shift that this difference has already added
        difference = difference + run.state.restored[operation.name]
    line = run.state.finger_line
    if line is not None:  # CENTER measures only along the finger line; all else is servo error
        difference = (difference @ line) * line
    run.state.saved[operation.name] = difference
    run.state.heights[operation.name] = run.drive.height
    run.emit(Saved(time=run.time, name=operation.name, difference=vector(difference)))


def here(run: ExecutionContext, operation: Here) -> None:
    """Define a position as the present pose of the hand."""
    name = operation.position
    seen = run.world.seen_from(run.world.positions[name].of, run.drive.hand())
    run.state.world.moved[name] = seen
    run.emit(PositionDefined(time=run.time, name=name, at=seen.at, of=seen.of))


def where(run: ExecutionContext, _: Where) -> None:
    """Report the pose of the hand."""
    run.emit(HandTold(time=run.time, at=rounded_place(run.drive.hand())))


def load(run: ExecutionContext, operation: Load) -> None:
    """Make the servo compensate a weight in the hand."""
    run.drive.state.load = operation.weight


def tool(run: ExecutionContext, operation: Tool) -> None:
    """Set the speed of the screwdriver's motor."""
    drive = run.drive.state
    drive.tool, drive.current, drive.starting, drive.lately = operation.speed, 0.0, [], []


def nothing(_: ExecutionContext, __: Operation) -> None:
    """Do nothing. The executor uses this function for operations that only select the next step or call the
    operator.
    """


FLOW_ACTIONS: Final[dict[type[Operation], Action]] = {
    Assign: assign,
    Search: search,
    Advance: advance,
    Save: save,
    Here: here,
    Where: where,
    Load: load,
    Tool: tool,
    Jump: nothing,
    Undo: nothing,
    Wait: nothing,
}
DECISIONS: Final[dict[type[Operation], Decision]] = {Test: test_error, Countdown: count_down}
