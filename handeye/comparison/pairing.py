"""Pairs the steps of two runs, and puts both runs on one timeline."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cached_property, lru_cache
from typing import Final, TypeVar

from handeye.core.entries import entry_named
from handeye.core.record import Record
from handeye.core.source import line_name
from handeye.inspection.difference import Pair, aligned
from handeye.program.events import StepStarted, UndoStarted
from handeye.report.recorded import RecordedRun
from handeye.runs.system import Listing, StepFacts
from handeye.runs.systems import system_named
from handeye.trace.stages import DoneStep, done_steps


class Place(Record, frozen=True, kw_only=True):
    """A step at the time when it was executed."""

    stage: str
    step: int
    file: str = ""  # required file that contains the step; empty for the script itself
    line: int
    text: str
    time: float  # time at which the step began, in seconds since the run began

    @property
    def name(self) -> str:
        """The line of the step in the form in which messages give it: `12`, or `pins.al:12`."""
        return line_name(self.line, self.file)


@lru_cache(maxsize=4)
def listing_of(run: RecordedRun) -> Listing:
    """Return the stages and steps of a run's program."""
    system, trace = system_named(run.trace.head.system), run.trace
    return system.listing(system.decode(trace.plan, f"the plan in {trace.name}"))


def _aligned_texts(before: Sequence[str], after: Sequence[str]) -> Sequence[Pair]:
    """Pair steps with equal texts, in the order of both programs. A step without a counterpart is paired with
    None."""
    pairs: list[Pair] = []
    for what, a, b, c, d in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        if what == "equal":
            pairs += zip(range(a, b), range(c, d), strict=True)
        else:
            pairs += [*((n, None) for n in range(a, b)), *((None, n) for n in range(c, d))]
    return pairs


def place_of(run: RecordedRun, started: StepStarted) -> Place:
    """Return the place of a step in the script. `started` is the event with which the step began."""
    program = listing_of(run)
    return Place(
        stage=program.stages[program.steps[started.step].stage],
        step=started.step,
        file=started.file,
        line=started.line,
        text=started.text,
        time=started.time,
    )


Turn = tuple[int, int]  # An execution of a step: number of its pair, and count of earlier executions
Fact = TypeVar("Fact")


@dataclass(frozen=True, slots=True)
class CarriedOut:
    """An executed step of a run."""

    run: RecordedRun
    turn: Turn
    done: DoneStep

    @property
    def step(self) -> StepFacts:
        """The step in the listing of the program."""
        return listing_of(self.run).steps[self.done.started.step]

    @property
    def place(self) -> Place:
        """The place of the step in the script."""
        return place_of(self.run, self.done.started)


@dataclass(frozen=True, eq=False)
class TwoRuns:
    """Two runs, with their steps paired."""

    a: RecordedRun
    b: RecordedRun

    @property
    def thinned(self) -> bool:
        """True if either trace is thinned. A thinned trace lacks some servo periods, so servo periods cannot be
        compared.
        """
        return self.a.trace.thinned or self.b.trace.thinned

    @cached_property
    def pairs(self) -> Sequence[Pair]:
        """Pairs of step numbers of the two programs, in the order of the text. If a step has no counterpart, the other
        number of its pair is None.
        """
        before, after = (listing_of(run).steps for run in (self.a, self.b))
        if before == after:
            return [(n, n) for n in range(len(before))]
        if self.planned:
            return aligned(self.a.program.steps, self.b.program.steps)
        return _aligned_texts([step.text for step in before], [step.text for step in after])

    @property
    def planned(self) -> bool:
        """True if both runs follow plans of motions."""
        return all("plans" in entry_named(run.trace.head.system).can for run in (self.a, self.b))

    @cached_property
    def numbers(self) -> tuple[Mapping[int, int], Mapping[int, int]]:
        """Two dictionaries, one for each program. Each maps the number of a step to the number of the step's partner
        in the other program.
        """
        a, b = (
            {step: number for number, pair in enumerate(self.pairs) if (step := pair[side]) is not None}
            for side in (0, 1)
        )
        return a, b

    def are_beside(self, a: int, b: int) -> bool:
        """Return True if step `a` of the first program and step `b` of the second are a pair."""
        return self.numbers[0][a] == self.numbers[1][b]

    @cached_property
    def carried_out(self) -> tuple[tuple[CarriedOut, ...], tuple[CarriedOut, ...]]:
        """The executed steps of each run, in order."""
        return tuple(_turns(self.a, self.numbers[0])), tuple(_turns(self.b, self.numbers[1]))


def _turns(run: RecordedRun, numbers: Mapping[int, int]) -> Iterator[CarriedOut]:
    before: Counter[int] = Counter()
    for done in done_steps(run.trace.events):
        if isinstance(done.started, UndoStarted):
            continue  # the arm undid a step instead of executing one
        number = numbers[done.started.step]
        yield CarriedOut(run, (number, before[number]), done)
        before[number] += 1


def side_by_side(a: Mapping[Turn, Fact], b: Mapping[Turn, Fact]) -> Iterator[tuple[Fact | None, Fact | None]]:
    """For each executed step, in the order of the script, yield the facts that the two runs have about this step. None
    stands for a run that has no fact about the step.
    """
    for turn in sorted({*a, *b}):
        yield a.get(turn), b.get(turn)


_BEFORE: Final = -1  # pair number for the time before the first step


@dataclass(frozen=True, slots=True, kw_only=True)
class Leg:
    """A segment of the timeline. In a leg, both runs execute the same step, or one run executes a step while the
    other waits.
    """

    begin: float  # s on the common timeline
    a: float
    """Time in the first run at the beginning of the leg, in s since that run began. During the leg, the time in the
    run advances evenly to the value of `a` in the next leg.
    """
    b: float
    places: tuple[Place | None, Place | None]
    """The step of each run; None while the run waits, or before the run begins."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Course:
    """The common timeline of two runs."""

    legs: tuple[Leg, ...]
    end: float  # s on the common timeline
    a: float  # end of the first run, s since it began
    b: float

    def at(self, place: Place, side: int) -> float:
        """Return the time on the common timeline (s) at which a step of a run begins. `side` is 0 for the first
        run and 1 for the second."""
        return next(leg.begin for leg in self.legs if leg.places[side] == place)


@dataclass(frozen=True, slots=True)
class _TimedStep:
    """A step of a run with the times at which it begins and ends (s)."""

    place: Place | None
    begin: float
    end: float


def course(runs: TwoRuns) -> Course:
    """Align two runs step by step. If both runs executed a step, this step takes as long on the timeline as it took in
    the slower run.
    """
    a, b = (_done(run, steps) for run, steps in zip((runs.a, runs.b), runs.carried_out, strict=True))
    legs: list[Leg] = []
    time, at = 0.0, (a[0].begin, b[0].begin)
    for one, other in _side_by_side(runs, a, b):
        places = None if one is None else one.place, None if other is None else other.place
        legs.append(Leg(begin=time, a=at[0], b=at[1], places=places))
        time += max(0.0 if each is None else each.end - each.begin for each in (one, other))
        at = at[0] if one is None else one.end, at[1] if other is None else other.end
    return Course(legs=tuple(legs), end=time, a=at[0], b=at[1])


def _done(run: RecordedRun, steps: Sequence[CarriedOut]) -> list[_TimedStep]:
    """Return the steps of a run with their times. Each step lasts until the next step begins. The time before the
    first step is an item of its own, which comes first.
    """
    begun = [each.place for each in steps]
    times = [*(place.time for place in begun), run.ends]
    first = _TimedStep(None, min(run.begins, times[0]), times[0])
    return [first, *(_TimedStep(place, *times[number : number + 2]) for number, place in enumerate(begun))]


def _side_by_side(
    runs: TwoRuns, a: Sequence[_TimedStep], b: Sequence[_TimedStep]
) -> Iterator[tuple[_TimedStep | None, _TimedStep | None]]:
    """Yield the pairs of steps in order. Steps that only one run executed come between the pairs. Among these, the
    steps of the first run come before those of the second.
    """
    one, other = ([_BEFORE, *(each.turn[0] for each in steps)] for steps in runs.carried_out)
    for tag, i, j, k, m in SequenceMatcher(None, one, other, autojunk=False).get_opcodes():
        if tag == "equal":
            yield from zip(a[i:j], b[k:m], strict=True)
        else:
            yield from ((each, None) for each in a[i:j])
            yield from ((None, each) for each in b[k:m])
