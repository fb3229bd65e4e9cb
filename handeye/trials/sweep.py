"""A sweep: trials of one kind in many worlds, each kept as it ends, and all of them counted.

A kind is a value, `Sweep`: what is kept of a trial, how its outcomes count, and which tables are made of many. All else
is the same for every kind: the folder in which a sweep continues where it was interrupted (`folder`), figures with
their intervals (`figures`), the terminal (`text`), the page (`page`), tables (`tables`), and comparing two
(`comparing`).
"""

from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any, Final, Generic, Literal, TypeVar

import msgspec

from handeye.core.host_time import HostTimer
from handeye.core.record import Record
from handeye.core.variation import Seed, checked_seed
from handeye.trials.workers import Answer, answers

if TYPE_CHECKING:
    from handeye.trials.folder import BatchFolder

Ended = Literal[
    "ended", "raised", "machine", "killed", "simulated limit", "processor limit", "wall limit", "not built"
]
"""A trial's end: by itself; by an exception; because this computer had no memory or no file for it; because its process
was killed; at a limit of simulated seconds, of seconds of the processor, or (in older batches) of the wall clock;
before there was anything to try it on."""
Standing = Literal["right", "wrong", "silent", "uncounted"]
"""The class of an outcome: a success; a failure; a failure that was taken for a success; not at all."""

FAILED: Final = "failed"  # Outcome of a trial that did not finish
GRACE: Final = 1.1
"""Multiple of the limit of processor time at which a process ends: it hangs where nothing looks at the limit."""
_CAME_TO_AN_END: Final = ("ended", "not built")
_OF_THE_MACHINE: Final = ("machine", "killed", "processor limit", "wall limit")
"""Ends that need not happen again: they are this computer's, not the program's."""
_BROKEN_OFF: Final[Mapping[str, str]] = {
    "killed": "its process was killed twice",
    "simulated limit": "reached the limit of simulated time",
    "processor limit": "reached the limit of CPU time",
    "wall limit": "reached the limit of wall-clock time",
}


class Case(Record, frozen=True, kw_only=True):
    """Trials that are executed together, in one world."""

    trials: tuple[int, ...]  # Their numbers among the trials of the condition, from 0
    seed: Seed
    condition: str = ""  # Condition under which they run; empty: there is only one

    def __post_init__(self) -> None:
        """Raises BadArgument if there is no such seed."""
        checked_seed(self.seed)


class TrialRow(Record, frozen=True, kw_only=True):
    """Record of one trial. Equal trials have equal rows, except for computing time and killed processes."""

    trial: Annotated[int, msgspec.Meta(ge=0)]
    seed: Seed
    condition: str = ""
    ended: Ended = "ended"
    raised: str = ""  # Type and words of the exception
    killed: Annotated[int, msgspec.Meta(ge=0)] = 0  # How often its process was killed
    wall_s: float = 0.0
    cpu_s: float = 0.0

    @property
    def key(self) -> tuple[str, int]:
        """Condition and number, which no other trial of a sweep has."""
        return self.condition, self.trial

    @property
    def broken_off(self) -> bool:
        """True if it did not end by itself."""
        return self.ended not in _CAME_TO_AN_END

    @property
    def to_be_tried_again(self) -> bool:
        """True if this computer broke it off, which says nothing about the program."""
        return self.ended in _OF_THE_MACHINE

    @property
    def verdict(self) -> str:
        """Its outcome, a key of `Sweep.outcomes`, or `failed`."""
        return FAILED if self.broken_off else self.outcome

    @property
    def outcome(self) -> str:
        """Outcome of a trial that ended by itself; each kind defines its own."""
        raise NotImplementedError

    @property
    def stage(self) -> str:
        """The stage in which a failed trial failed; empty if unknown."""
        return ""

    @property
    def line(self) -> str | None:
        """Line of the script where the program stopped."""
        return None

    @property
    def cause(self) -> str:
        """Why it failed, in equal words for equal causes."""
        return self.detail

    @property
    def detail(self) -> str:
        """Why it failed, with figures."""
        return self.raised or _BROKEN_OFF.get(self.ended, "")

    @property
    def measures(self) -> Mapping[str, float]:
        """Measured values by name and unit, as `peak, N`; none where there is no value."""
        return {}

    @property
    def facts(self) -> Mapping[str, float]:
        """Values that only the table of trials shows, in the same form."""
        return {}


R = TypeVar("R", bound=TrialRow)


@dataclass(frozen=True, slots=True, kw_only=True)
class Details:
    """A table that a kind of sweep adds to its figures: on the terminal, the page, as CSV, and in the JSON."""

    name: str  # Name of the table and of its key in the JSON
    title: str
    rows: Sequence[Record]
    """Flat records; their fields are the columns. Fields that end in `_share` are shares of 1, in `_s` seconds."""
    heads: tuple[str, ...]
    span: tuple[str, str, str] | None = None
    """Fields that are drawn as a bar with a dot in it: its low end, the dot, its high end."""

    def cells(self) -> list[tuple[str, ...]]:
        """The rows as shown."""
        names = self.rows[0].__struct_fields__ if self.rows else ()
        return [tuple(told(name, getattr(row, name)) for name in names) for row in self.rows]

    def number(self, column: int) -> bool:
        """A column has numbers."""
        row = self.rows[0]
        return not isinstance(getattr(row, row.__struct_fields__[column]), str)


def told(name: str, value: object) -> str:
    """A value of a field as shown."""
    if value is None:
        return ""
    if isinstance(value, float):
        return (
            percent(value)
            if name.endswith("_share")
            else f"{value:.1f} s"
            if name.endswith("_s")
            else f"{value:.3g}"
        )
    return str(value)


def percent(*parts: float | None) -> str:
    """Parts of one as percentages: `88.6 to 99.1 %`."""
    return f"{' to '.join(f'{100 * part:.1f}' for part in parts if part is not None)} %"


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep(Generic[R]):
    """A kind of sweep."""

    kind: str  # Its folders say so; of several words, the first is what `sweep_of` looks up
    row: type[R]
    outcomes: Mapping[str, Standing]
    success: str  # The word for trials that are right
    noun: str = "trial"
    sentence: Callable[[R], str] | None = None
    """Text printed as each trial ends, if not empty. None: failures are listed at the end."""
    narrated: bool = False  # Each trial is noted on standard error with the rate so far
    summary: Callable[[Sequence[R]], Sequence[str]] = field(default=lambda _: ())
    more: Callable[[Sequence[R]], Mapping[str, object]] = field(default=lambda _: {})
    """Further entries of the JSON."""
    details: Callable[[Sequence[R]], Sequence[Details]] = field(default=lambda _: ())
    work: "Callable[[Case], Sequence[R]] | None" = None
    """Runs the trials of a case, if it takes no options: such a kind has a command for nothing."""
    shared_worlds: bool = False
    """Several trials share a world: a seed is not that of trial 0 and the number of the trial."""

    def standing(self, row: R) -> Standing:
        """The class of a trial's outcome."""
        return "wrong" if row.broken_off else self.outcomes[row.outcome]


Work = Callable[[Case], Sequence[R]]
"""Runs the trials of a case. It is sent to other processes; what it raises is kept as how the trials ended."""


@dataclass(frozen=True, slots=True)
class GuardedWork(Generic[R]):
    """Work whose exceptions are results: of a thousand trials, none is worth the others."""

    work: Work[R]
    row: type[R]

    def __call__(self, case: Case) -> list[R]:
        """Run the trials of a case."""
        timer = HostTimer()
        try:
            rows = list(self.work(case))
        except Exception as error:
            ended: Ended = "machine" if isinstance(error, (MemoryError, OSError)) else "raised"
            rows = lost(self.row, case, ended=ended, raised=f"{type(error).__name__}: {error}")
        each = {"wall_s": round(timer.wall_s / len(rows), 3), "cpu_s": round(timer.cpu_s / len(rows), 3)}
        return [msgspec.structs.replace(row, **each) for row in rows]


def lost(row: type[R], case: Case, **fields: object) -> list[R]:
    """Rows of a case with lost trials: only how they ended is known."""
    return [row(trial=k, seed=case.seed, condition=case.condition, **fields) for k in case.trials]  # type: ignore[arg-type]


Engine = Callable[[GuardedWork[Any], Sequence[Case]], Generator[Answer[Case, list[Any]], None, None]]
"""Executes cases in any order; one whose process is lost is tried once more."""


def processes(jobs: int, cpu_limit_s: float | None = None) -> Engine:
    """Processes on this computer, kept from case to case; this one, if one is enough and nothing limits its time.

    Args:
        cpu_limit_s: seconds of the processor after which a case has taken too long.
    """

    def carry_out(
        work: GuardedWork[Any], cases: Sequence[Case]
    ) -> Generator[Answer[Case, list[Any]], None, None]:
        if cpu_limit_s is None and min(jobs, len(cases)) <= 1:
            return (Answer(item=case, value=work(case)) for case in cases)
        return answers(work, cases, jobs, limit_s=None if cpu_limit_s is None else cpu_limit_s * GRACE)

    return carry_out


def cases(seed: int, numbers: Sequence[int], conditions: Sequence[str] = ("",)) -> list[Case]:
    """One trial a world under each condition: trial k in the world of `seed` + k."""
    return [Case(trials=(k,), seed=seed + k, condition=each) for each in conditions for k in numbers]


def carry_out(
    sweep: Sweep[R],
    work: Work[R],
    cases: Sequence[Case],
    engine: Engine,
    *,
    folder: "BatchFolder[R] | None" = None,
    told: Callable[[R], None] = lambda _: None,
) -> tuple[R, ...]:
    """Rows of the trials of some cases, in their order, each `told` once it is kept; a folder's are not tried again."""
    rows: dict[tuple[str, int], R] = {} if folder is None else dict(folder.rows)
    todo = [case for case in cases if any((case.condition, number) not in rows for number in case.trials)]
    with closing(engine(GuardedWork(work, sweep.row), todo)) as carried_out:
        for answer in carried_out:
            for row in rows_of(sweep, answer):
                if folder is not None:
                    folder.append(row)
                rows[row.key] = row
                told(row)
    return tuple(rows[case.condition, number] for case in cases for number in case.trials)


def rows_of(sweep: Sweep[R], answer: Answer[Case, list[R]]) -> list[R]:
    """Rows of a case, also of one that was lost with its process; raises what failed outside of the trials."""
    if answer.error is not None:
        raise answer.error
    if answer.value is not None:
        return (
            [msgspec.structs.replace(row, killed=answer.killed) for row in answer.value]
            if answer.killed
            else answer.value
        )
    ended: Ended = "processor limit" if answer.overdue else "killed"
    return lost(sweep.row, answer.item, ended=ended, killed=answer.killed, wall_s=round(answer.wall_s, 3))
