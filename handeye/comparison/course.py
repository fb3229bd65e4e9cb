"""The course of two runs side by side: for every stretch of it, where each of the runs stood."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Final

from handeye.comparison.pairing import CarriedOut, Place, TwoRuns
from handeye.report.recorded import RecordedRun

_BEFORE: Final = -1  # pair number for the time before the first step


@dataclass(frozen=True, slots=True, kw_only=True)
class Leg:
    """A segment in which both runs did the same step, or one did a step and the other waited."""

    begin: float  # s of the course
    a: float
    """Where the first run stood then, s since it began; it goes evenly to where the next leg finds it."""
    b: float
    places: tuple[Place | None, Place | None]
    """The step of each run; None while it waits, or has not begun."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Course:
    """The timeline of two runs."""

    legs: tuple[Leg, ...]
    end: float  # s of the course
    a: float  # end of the first run, s since it began
    b: float

    def at(self, place: Place, side: int) -> float:
        """Start of a step of a run (0: the first), s of the timeline."""
        return next(leg.begin for leg in self.legs if leg.places[side] == place)


@dataclass(frozen=True, slots=True)
class _TimedStep:
    """A step of a run, with its times."""

    place: Place | None
    begin: float
    end: float


def course(runs: TwoRuns) -> Course:
    """Align two runs step by step: a common step takes as long as the longer one."""
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
    """Steps of a run, preceded by the time before; each lasts until the next begins."""
    begun = [each.place for each in steps]
    times = [*(place.time for place in begun), run.ends]
    first = _TimedStep(None, min(run.begins, times[0]), times[0])
    return [first, *(_TimedStep(place, *times[number : number + 2]) for number, place in enumerate(begun))]


def _side_by_side(
    runs: TwoRuns, a: Sequence[_TimedStep], b: Sequence[_TimedStep]
) -> Iterator[tuple[_TimedStep | None, _TimedStep | None]]:
    """Pairs of steps, and between them those of one run alone, the first run's before the other's."""
    one, other = ([_BEFORE, *(each.turn[0] for each in steps)] for steps in runs.carried_out)
    for tag, i, j, k, m in SequenceMatcher(None, one, other, autojunk=False).get_opcodes():
        if tag == "equal":
            yield from zip(a[i:j], b[k:m], strict=True)
        else:
            yield from ((each, None) for each in a[i:j])
            yield from ((None, each) for each in b[k:m])
