"""Steps as they were carried out, and which step of one run is which of another."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

from handeye.core.record import Record
from handeye.core.source import line_name
from handeye.inspection.alignment import Pair, aligned
from handeye.program.events import StepStarted, UndoStarted
from handeye.program.program import Step
from handeye.report.recorded import Recorded
from handeye.trace.steps import DoneStep, done_steps


class Place(Record, frozen=True, kw_only=True):
    """A step as it was carried out."""

    stage: str
    step: int
    """Its number in its program."""
    file: str = ""
    """The required file it stands in; empty: the source itself."""
    line: int
    text: str
    time: float
    """When it began, s since the run began."""

    @property
    def name(self) -> str:
        """Its line, as people are told: `12`, or `pins.al:12`."""
        return line_name(self.line, self.file)


def place_of(run: Recorded, started: StepStarted) -> Place:
    """The place of a step that was begun."""
    program = run.program
    return Place(
        stage=program.stages[program.steps[started.step].stage],
        step=started.step,
        file=started.file,
        line=started.line,
        text=started.text,
        time=run.seconds(started.time),
    )


Turn = tuple[int, int]
"""A step as it is carried out: the number of its pair, and how often that was carried out before."""
Fact = TypeVar("Fact")


@dataclass(frozen=True, slots=True)
class CarriedOut:
    """A step as a run carried it out."""

    run: Recorded
    turn: Turn
    done: DoneStep

    @property
    def step(self) -> Step:
        """Its step in the program."""
        return self.run.program.steps[self.done.started.step]

    @property
    def place(self) -> Place:
        """Its place."""
        return place_of(self.run, self.done.started)


@dataclass(frozen=True, eq=False)
class TwoRuns:
    """Two runs, and the pairs of their steps."""

    a: Recorded
    b: Recorded

    @property
    def thinned(self) -> bool:
        """True if a trace holds some of its servo periods only, so that these cannot be compared."""
        return self.a.trace.thinned or self.b.trace.thinned

    @cached_property
    def pairs(self) -> Sequence[Pair]:
        """Numbers of a step in each program, in the order of the texts; None: the other has none like it."""
        before, after = (run.program.steps for run in (self.a, self.b))
        return [(n, n) for n in range(len(before))] if before == after else aligned(before, after)

    @cached_property
    def numbers(self) -> tuple[Mapping[int, int], Mapping[int, int]]:
        """For each program, the number of the pair that each of its steps is in."""
        a, b = (
            {step: number for number, pair in enumerate(self.pairs) if (step := pair[side]) is not None}
            for side in (0, 1)
        )
        return a, b

    def are_beside(self, a: int, b: int) -> bool:
        """True if steps of the two programs, by their numbers, are a pair."""
        return self.numbers[0][a] == self.numbers[1][b]

    @cached_property
    def carried_out(self) -> tuple[tuple[CarriedOut, ...], tuple[CarriedOut, ...]]:
        """The steps that each run carried out, in order."""
        return tuple(_turns(self.a, self.numbers[0])), tuple(_turns(self.b, self.numbers[1]))


def _turns(run: Recorded, numbers: Mapping[int, int]) -> Iterator[CarriedOut]:
    before: Counter[int] = Counter()
    for done in done_steps(run.trace.events):
        if isinstance(done.started, UndoStarted):
            continue  # the arm took a step back, and carried none out
        number = numbers[done.started.step]
        yield CarriedOut(run, (number, before[number]), done)
        before[number] += 1


def side_by_side(a: Mapping[Turn, Fact], b: Mapping[Turn, Fact]) -> Iterator[tuple[Fact | None, Fact | None]]:
    """Facts about the same turn in two runs, in the order of the script; None: one of them has none."""
    for turn in sorted({*a, *b}):
        yield a.get(turn), b.get(turn)
