"""Defines the row of one trial of a planned program, with the trial's contact operations and searches."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from handeye.core.errors import ERRORS, SEARCH_EXHAUSTED
from handeye.core.record import Record
from handeye.program.events import AnyEvent, ErrorRaised, SearchAdvanced, StepStarted
from handeye.program.flow_operations import Search
from handeye.program.motion_operations import Move
from handeye.program.program import Program
from handeye.results.result import Result
from handeye.trials.sweep import Standing, TrialRow


class Contact(Record, frozen=True, kw_only=True):
    """One contact operation. The operation begins with the motion to the position `at`, and ends when the hand moves
    to another position."""

    operation: str
    at: str  # Name of the position
    done: bool  # The program continued after the operation


class SearchEnd(Record, frozen=True, kw_only=True):
    """The outcome of one search of a trial."""

    at: str  # The position around which the program searched
    places: int  # number of places tried, including the first
    found: bool  # True if the last place was the right one


def contacts(
    program: Program, events: Sequence[AnyEvent], where: Mapping[str, tuple[str, ...]], *, completed: bool
) -> Iterator[Contact]:
    """Yield the contact operations of a trial, the earliest first. The keys of `where` are the names of the
    operations, and the values are the positions at which the operations take place.
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
    """Yield the searches in which the hand moved, the earliest first."""
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
    """Yield the positions to which the hand moved."""
    for event in events:
        if isinstance(event, StepStarted):
            operation = program.steps[event.step].operation
            if isinstance(operation, Move):
                yield operation.goal


OUTCOMES: Final[Mapping[str, Standing]] = {"assembled": "right", "silent": "silent", "stopped": "wrong"}
"""Outcomes of an assembly. `assembled`: the referee accepted the work. `silent`: the program reported success, but the
work is wrong. `stopped`: the program called the operator.
"""
APART: Final[Mapping[str, Standing]] = {
    "apart": "right", "silent": "silent", "stopped": "wrong", "not built": "uncounted",
}  # fmt: skip
"""Outcomes of a dismantling. `apart`: everything is back in its place. `silent`: the program reported success, but
something is out of place. `stopped`: the program called the operator. `not built`: there was nothing to dismantle.
"""


class Row(TrialRow, frozen=True, kw_only=True):
    """One trial of a planned program."""

    result: Result | None = None
    place: str | None = None  # Line of the script where the program stopped
    events: str = ""  # Digest of all events: sixteen hexadecimal digits
    contacts: tuple[Contact, ...] = ()
    searches: tuple[SearchEnd, ...] = ()
    force: float | None = None
    """Greatest force on the hand while the arm undid its work (N); None if nothing was undone."""

    def __post_init__(self) -> None:
        """Check that the row has a result, or a reason for its absence. Raises ValueError if the row has neither."""
        if self.result is None and not self.broken_off:
            raise ValueError(f"a trial that counts as {self.ended!r} has no result")

    @property
    def outcome(self) -> str:
        if self.ended == "not built" or self.result is None:
            return "not built"
        right = "apart" if self.result.apart is True else "assembled"
        return {0: right, 1: "stopped", 3: "silent"}[self.result.exit_code]

    @property
    def stage(self) -> str:
        if self.result is None:
            return ""
        return "referee" if self.result.completed else self.result.stopped_at or "setting up"

    @property
    def line(self) -> str | None:
        return self.place

    @property
    def cause(self) -> str:
        if self.broken_off or self.result is None:
            return super().detail
        if not self.result.completed:
            return ERRORS.get(self.result.error or 0, self.result.message)
        return ", ".join(name for name, check in self.result.referee.items() if check.refuses)

    @property
    def detail(self) -> str:
        if self.broken_off or self.result is None:
            return super().detail
        if not self.result.completed:
            return self.result.message
        return "; ".join(check.told for check in self.result.referee.values() if check.refuses)

    @property
    def measures(self) -> Mapping[str, float]:
        if self.result is None or self.broken_off:
            return {}
        if self.force is not None:
            return {"greatest force, N": self.force} if self.outcome == "apart" else {}
        return {"arm time, s": self.result.timing.manipulation_s}
