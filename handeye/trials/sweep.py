"""Executes a sweep: trials of one kind in many worlds. Each trial is saved when it ends, and statistics are
computed over all of them.

A kind is a value of type `Sweep`. A kind defines the record of a trial, the class of each outcome, and the tables made
from many trials. Everything else is common to all kinds, and is in other modules. `figures` computes the statistics
with their confidence intervals. `text` makes the output on the terminal, `page` the HTML page, and `tables` the tables
for other programs. `comparing` compares batches. `folder` stores the sweep; an interrupted sweep can continue from its
folder.
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
"""How a trial ended. `ended`: by itself. `raised`: by an exception. `machine`: this computer lacked memory or could
not open a file. `killed`: the trial's process was killed. The three limits: the trial reached a limit of simulated
time, of CPU time, or (in older batches) of wall-clock time. `not built`: the work that the trial needs was not built.
"""
Standing = Literal["right", "wrong", "silent", "uncounted"]
"""The class of an outcome. `right`: success. `wrong`: failure. `silent`: a failure that the program reported as a
success. `uncounted`: the trial does not count.
"""

FAILED: Final = "failed"  # Outcome of a trial that did not finish
GRACE: Final = 1.1
"""A process is ended when its CPU time reaches this multiple of the limit. Such a process hangs in code that does
not check the limit.
"""
_CAME_TO_AN_END: Final = ("ended", "not built")
_OF_THE_MACHINE: Final = ("machine", "killed", "processor limit", "wall limit")
"""The ways in which this computer, and not the program, ends a trial. A trial that this computer ended may end
differently when it is repeated.
"""
_BROKEN_OFF: Final[Mapping[str, str]] = {
    "killed": "its process was killed twice",
    "simulated limit": "reached the limit of simulated time",
    "processor limit": "reached the limit of CPU time",
    "wall limit": "reached the limit of wall-clock time",
}


class Case(Record, frozen=True, kw_only=True):
    """One or more trials that are executed together in one world."""

    trials: tuple[int, ...]  # Numbers of the trials, among those of the condition, from 0
    seed: Seed
    condition: str = ""  # Condition under which the trials run; empty: there is only one condition

    def __post_init__(self) -> None:
        """Check the seed. Raises BadArgument if the seed is out of range."""
        checked_seed(self.seed)


class TrialRow(Record, frozen=True, kw_only=True):
    """The record of one trial. Equal trials have equal rows, except for computing time and killed processes."""

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
        """The condition and the number of the trial. Together they identify the trial within its sweep."""
        return self.condition, self.trial

    @property
    def broken_off(self) -> bool:
        """True if the trial did not end by itself."""
        return self.ended not in _CAME_TO_AN_END

    @property
    def to_be_tried_again(self) -> bool:
        """True if a problem of this computer ended the trial, so that the trial says nothing about the program."""
        return self.ended in _OF_THE_MACHINE

    @property
    def verdict(self) -> str:
        """Outcome of the trial: a key of `Sweep.outcomes`, or `failed`."""
        return FAILED if self.broken_off else self.outcome

    @property
    def outcome(self) -> str:
        """Outcome of a trial that ended by itself. Each kind of trial defines its outcomes."""
        raise NotImplementedError

    @property
    def stage(self) -> str:
        """The stage in which the trial failed; empty if unknown."""
        return ""

    @property
    def line(self) -> str | None:
        """Line of the script at which the program stopped."""
        return None

    @property
    def cause(self) -> str:
        """Cause of the failure, in words. Equal causes have equal words, so failures can be counted by cause."""
        return self.detail

    @property
    def detail(self) -> str:
        """Cause of the failure, in words and numbers."""
        return self.raised or _BROKEN_OFF.get(self.ended, "")

    @property
    def measures(self) -> Mapping[str, float]:
        """Measured values, by a name with a unit, such as `peak, N`. Missing values are left out."""
        return {}

    @property
    def facts(self) -> Mapping[str, float]:
        """Values that appear only in the table of trials. Each key is a name with its unit, such as `error_x, mm`."""
        return {}


R = TypeVar("R", bound=TrialRow)


@dataclass(frozen=True, slots=True, kw_only=True)
class Details:
    """A table that a kind of sweep adds to its statistics. The table appears on the terminal, on the page, as CSV and
    in the JSON output."""

    name: str  # Name of the table and of its key in the JSON
    title: str
    rows: Sequence[Record]
    """Flat records, whose fields are the columns. Fields that end in `_share` are fractions of 1. Fields that end in
    `_s` are seconds.
    """
    heads: tuple[str, ...]
    span: tuple[str, str, str] | None = None
    """Fields drawn as a bar with a dot: low end, dot, high end."""

    def cells(self) -> list[tuple[str, ...]]:
        """Return the rows as they are displayed."""
        names = self.rows[0].__struct_fields__ if self.rows else ()
        return [tuple(told(name, getattr(row, name)) for name in names) for row in self.rows]

    def number(self, column: int) -> bool:
        """Return True if a column contains numbers."""
        row = self.rows[0]
        return not isinstance(getattr(row, row.__struct_fields__[column]), str)


def told(name: str, value: object) -> str:
    """Return the value of a field as it is displayed."""
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
    """Return fractions as percentages, such as `88.6 to 99.1 %`."""
    return f"{' to '.join(f'{100 * part:.1f}' for part in parts if part is not None)} %"


@dataclass(frozen=True, slots=True, kw_only=True)
class Sweep(Generic[R]):
    """A kind of sweep."""

    kind: str  # Written in the folders of its batches; `sweep_of` uses the first word
    row: type[R]
    outcomes: Mapping[str, Standing]
    success: str  # The word for a right trial
    noun: str = "trial"
    sentence: Callable[[R], str] | None = None
    """A function that returns the text to print when a trial ends; an empty text is not printed. If there is no
    function, the failures are listed at the end instead.
    """
    narrated: bool = False  # Each trial is reported on standard error, with the rate so far
    summary: Callable[[Sequence[R]], Sequence[str]] = field(default=lambda _: ())
    more: Callable[[Sequence[R]], Mapping[str, object]] = field(default=lambda _: {})
    """Further entries for the JSON."""
    details: Callable[[Sequence[R]], Sequence[Details]] = field(default=lambda _: ())
    work: "Callable[[Case], Sequence[R]] | None" = None
    """The function that executes the trials of a case. Only a kind of trial without options has this function, and
    such a kind needs no command of its own.
    """
    shared_worlds: bool = False
    """True if several trials share a world. The number of a trial then does not determine the seed of its world."""

    def standing(self, row: R) -> Standing:
        """Say how a trial's outcome counts: as a success, as a failure, as a silent failure, or not at all."""
        return "wrong" if row.broken_off else self.outcomes[row.outcome]


Work = Callable[[Case], Sequence[R]]
"""A function that executes the trials of a case. The function is sent to other processes. If the function raises an
exception, the exception is recorded as the end of the trials.
"""


@dataclass(frozen=True, slots=True)
class GuardedWork(Generic[R]):
    """Wraps the work of a case. An exception becomes a result, so that a failed trial does not end the sweep."""

    work: Work[R]
    row: type[R]

    def __call__(self, case: Case) -> list[R]:
        """Execute the trials of a case."""
        timer = HostTimer()
        try:
            rows = list(self.work(case))
        except Exception as error:
            ended: Ended = "machine" if isinstance(error, (MemoryError, OSError)) else "raised"
            rows = lost(self.row, case, ended=ended, raised=f"{type(error).__name__}: {error}")
        each = {"wall_s": round(timer.wall_s / len(rows), 3), "cpu_s": round(timer.cpu_s / len(rows), 3)}
        return [msgspec.structs.replace(row, **each) for row in rows]


def lost(row: type[R], case: Case, **fields: object) -> list[R]:
    """Return rows for the lost trials of a case. The rows record only how the trials ended."""
    return [row(trial=k, seed=case.seed, condition=case.condition, **fields) for k in case.trials]  # type: ignore[arg-type]


Engine = Callable[[GuardedWork[Any], Sequence[Case]], Generator[Answer[Case, list[Any]], None, None]]
"""A function that executes cases in any order. If the process of a case is lost, the function repeats the case once."""


def processes(jobs: int, cpu_limit_s: float | None = None) -> Engine:
    """Return an engine that executes cases in worker processes on this computer. With one job and no time
    limit, it executes the cases in this process.

    Args:
        cpu_limit_s: CPU time limit for a case (s).
    """

    def carry_out(
        work: GuardedWork[Any], cases: Sequence[Case]
    ) -> Generator[Answer[Case, list[Any]], None, None]:
        if cpu_limit_s is None and min(jobs, len(cases)) <= 1:
            return (Answer(item=case, value=work(case)) for case in cases)
        return answers(work, cases, jobs, limit_s=None if cpu_limit_s is None else cpu_limit_s * GRACE)

    return carry_out


def cases(seed: int, numbers: Sequence[int], conditions: Sequence[str] = ("",)) -> list[Case]:
    """Return one case per world and condition. Trial k is in the world of `seed` + k."""
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
    """Execute trials, and return their rows in the order of the cases. Trials that are already in the folder
    are not repeated. `told` is called for each row after the row has been saved.
    """
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
    """Return the rows of a case. If the process of the case ended without a result, the rows record only how it ended.
    Raises errors that did not come from the trials.
    """
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
