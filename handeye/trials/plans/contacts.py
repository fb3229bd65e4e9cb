"""Contact operations and searches of a run, by what happened in it."""

from collections.abc import Iterator, Mapping, Sequence

from handeye.core.errors import SEARCH_EXHAUSTED
from handeye.core.record import Record
from handeye.program.events import AnyEvent, ErrorRaised, SearchAdvanced, StepStarted
from handeye.program.flow_operations import Search
from handeye.program.motion_operations import Move
from handeye.program.program import Program


class Contact(Record, frozen=True, kw_only=True):
    """One contact operation: from the motion to where it happens until the hand goes somewhere else."""

    operation: str
    at: str
    """The position."""
    done: bool
    """The program went on behind it."""


class SearchEnd(Record, frozen=True, kw_only=True):
    """One search."""

    at: str
    """The position that it is around."""
    places: int
    """ScheduleResult, the first included."""
    found: bool
    """It did not come to its last place in vain."""


def contacts(
    program: Program, events: Sequence[AnyEvent], where: Mapping[str, tuple[str, ...]], *, completed: bool
) -> Iterator[Contact]:
    """The contact operations that were begun, in their order.

    Args:
        where: positions at which they happen, by their names.
        completed: the program came to its end.
    """
    names = {position: name for name, positions in where.items() for position in positions}
    here = ""
    for goal in _goals(program, events):
        if goal != here and here in names:
            yield Contact(operation=names[here], at=here, done=True)
        here = goal
    if here in names:
        yield Contact(operation=names[here], at=here, done=completed)


def searches(program: Program, events: Sequence[AnyEvent]) -> Iterator[SearchEnd]:
    """The searches in which the hand went anywhere, in their order."""
    under_way: SearchEnd | None = None
    for event in events:
        if isinstance(event, StepStarted):
            operation = program.steps[event.step].operation
            if isinstance(operation, Search):
                yield from _ended(under_way)
                under_way = SearchEnd(at="", places=1, found=True)
            elif isinstance(operation, Move) and operation.searching and under_way is not None:
                under_way = _with(under_way, at=operation.goal)
        elif isinstance(event, SearchAdvanced) and under_way is not None:
            under_way = _with(under_way, places=event.count + 1)
        elif isinstance(event, ErrorRaised) and event.number == SEARCH_EXHAUSTED and under_way is not None:
            under_way = _with(under_way, found=False)
    yield from _ended(under_way)


def _with(search: SearchEnd, *, at: str = "", places: int = 0, found: bool = True) -> SearchEnd:
    return SearchEnd(at=at or search.at, places=places or search.places, found=search.found and found)


def _ended(search: SearchEnd | None) -> Iterator[SearchEnd]:
    if search is not None and search.at:
        yield search


def _goals(program: Program, events: Sequence[AnyEvent]) -> Iterator[str]:
    """The positions that the hand went to."""
    for event in events:
        if isinstance(event, StepStarted):
            operation = program.steps[event.step].operation
            if isinstance(operation, Move):
                yield operation.goal
