"""The comparison of two runs in lines of text, in the units of the arm language."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from handeye.comparison.comparison import Compared, Comparison
from handeye.comparison.conditions import Condition
from handeye.comparison.corrected import Correction, Corrections
from handeye.comparison.felt import Stop, Stops
from handeye.comparison.first import First
from handeye.comparison.otherwise import EVENT
from handeye.comparison.parting import Parting, Turning
from handeye.comparison.place import Place
from handeye.comparison.searched import Search, Searches
from handeye.events import AnyEvent, StepStarted
from handeye.plain_text import counted, one_line
from handeye.program.guards import GuardKind
from handeye.see.facts.outcome import Kind
from handeye.trace.account import ASTRAY
from handeye.trace.quantity_text import quantity_text, values_text
from handeye.trace.sentences import inches, sentence
from handeye.trace.stats import StageFigures
from handeye.units import DEGREE, INCH, UNITS

_CAME_TO: Final[dict[Kind, str]] = {
    "right": "it ended, and the work is right",
    "wrong": "it ended, and the work is not right",
    "ended": "it came to its end",
    "stopped": "it stopped and called the operator",
    "panic": "the panic button was hit",
    "paused": "it stands before its end",
    "broken off": "its trace was cut short",
}
_BOTH: Final = ("A", "B")
_UNITS: Final[Mapping[GuardKind, str]] = {
    GuardKind.FORCE: "oz",
    GuardKind.AGAINST: "oz",
    GuardKind.MOMENT: "oz in",
    GuardKind.TORQUE: "oz in",
}
"""Units in which people are told what a guard looked at."""


def comparison_text(found: Comparison) -> list[str]:
    """A comparison as lines of text."""
    runs = [f"{letter}  {_run(run)}" for letter, run in zip(_BOTH, (found.a, found.b), strict=True)]
    lines = [*runs, *_conditions(found.conditions)]
    if found.first is None:
        return [*lines, "", "Nothing was recorded otherwise: both did the same, to the last bit."]
    sections = (
        _first(found.first),
        _parted(found.parted),
        _searched(found.searches),
        _felt(found.stops),
        _corrected(found.corrections),
        _took(found),
    )
    return [*lines, *(line for section in map(tuple, sections) if section for line in ("", *section))]


def _run(run: Compared) -> str:
    return f"{run.name}: {run.program}, {run.world}, {run.seconds:.1f} s: {_CAME_TO[run.came_to]}"


def _conditions(differing: Sequence[Condition]) -> Iterator[str]:
    """What the runs depended on differently; they are compared as far as they go."""
    for each in differing:
        if each.what == "plan":
            yield "They are of different plans, compared as far as these go; `handeye diff` compares plans."
        else:
            yield f"{each.what}: {each.a} in A, {each.b} in B"


# -- what went otherwise ---------------------------------------------------------------------------------------


def _first(first: First) -> Iterator[str]:
    period = "" if first.period is None else f", servo period {first.period}"
    yield f"Recorded otherwise first: {_where(first.place)}{period}"
    if first.differing.quantity == EVENT:
        yield f"  A: {_next(first.next[0])}"
        yield f"  B: {_next(first.next[1])}"
    else:
        one, other = values_text(first.differing)
        yield f"  {quantity_text(first.differing.quantity)}: A {one}, B {other}"


def _next(event: AnyEvent | None) -> str:
    return "no event yet" if event is None else sentence(event)


def _parted(parted: Parting | None) -> Iterator[str]:
    if parted is None:
        yield "Both went the same way: the same steps, stops, errors and answers."
        return
    yield f"Their ways part: {_where(parted.place)}"
    yield f"  A: {_turning(parted.a)}"
    yield f"  B: {_turning(parted.b)}"


def _turning(turning: Turning | None) -> str:
    if turning is None:
        return "it has ended"
    if isinstance(turning.event, StepStarted):
        return f"it goes on at line {turning.event.place}: {one_line(turning.event.text)}"
    return sentence(turning.event)


def _where(place: Place | None) -> str:
    """A step, as people find it."""
    if place is None:
        return "before the first step"
    return f"{place.stage}, line {place.name}: {one_line(place.text)}"


# -- what each searched, felt and corrected ------------------------------------------------------------------------


def _searched(found: Sequence[Searches]) -> Iterator[str]:
    if not found:
        return
    both = [(each.a, each.b) for each in found if each.a is not None and each.b is not None]
    other = [(a, b) for a, b in both if (a.places, a.exhausted) != (b.places, b.exhausted)]
    yield f"Searches: {len(both)} in both, {len(both) - len(other)} with as many places{_alone(found)}"
    for a, b in other:
        yield f"  {_where(a.place)}: A {_places(a)}, B {_places(b)}"


def _places(search: Search) -> str:
    return counted(search.places, "place") + (", all of them" if search.exhausted else "")


def _felt(found: Sequence[Stops]) -> Iterator[str]:
    if not found:
        return
    both = [(each.a, each.b) for each in found if each.a is not None and each.b is not None]
    other = [(a, b) for a, b in both if a.guard != b.guard]
    yield f"Guarded motions: {len(both)} in both, {len(both) - len(other)} ended alike{_alone(found)}"
    for a, b in other:
        yield f"  {_where(a.place)}: A {_stop(a)}, B {_stop(b)}"


def _stop(stop: Stop) -> str:
    if stop.guard is None or stop.value is None:
        return "was not stopped"
    unit = _UNITS.get(stop.guard)
    told = "" if unit is None else f" at {stop.value / UNITS[unit].size:.1f} {unit}"
    return f"was stopped by {stop.guard.value}{told}"


def _corrected(found: Sequence[Corrections]) -> Iterator[str]:
    if not found:
        return
    both = [(each.a, each.b, each.apart) for each in found if each.a is not None and each.b is not None]
    apart = [(a, b, off) for a, b, off in both if off is not None and off > ASTRAY]
    yield (
        f"Corrections: {len(both)} in both, {len(both) - len(apart)} within {ASTRAY / INCH:.2f} in of each other"
        f"{_alone(found)}"
    )
    for a, b, off in apart:
        yield f"  {_where(a.place)}: {a.name} in A {_at(a)}, in B {_at(b)}: {off / INCH:.2f} in apart"


def _at(found: Correction) -> str:
    turned = "" if found.yaw is None else f", turned {found.yaw / DEGREE:.1f} deg"
    return f"{inches(found.at)}{turned}"


def _alone(found: Sequence[Searches | Stops | Corrections]) -> str:
    """How many only one of the runs came to."""
    counts = sum(each.b is None for each in found), sum(each.a is None for each in found)
    told = (f"; {count} in {letter} alone" for letter, count in zip(_BOTH, counts, strict=True) if count)
    return "".join(told)


# -- what they took --------------------------------------------------------------------------------------------


def _took(found: Comparison) -> Iterator[str]:
    """A row for each stage, and one for all: simulated seconds of both, and by how much B took longer."""
    wide = max(map(len, ("Seconds", *(stage.name for stage in found.stages))))
    yield f"{'Seconds':{wide}}{'A':>9}{'B':>9}{'B - A':>9}"
    for stage in found.stages:
        yield _row(stage.name, wide, _seconds(stage.a), _seconds(stage.b))
    yield _row("all", wide, found.a.seconds, found.b.seconds)


def _seconds(figures: StageFigures | None) -> float | None:
    return None if figures is None else figures.seconds


def _row(name: str, wide: int, a: float | None, b: float | None) -> str:
    longer = "" if a is None or b is None else f"{b - a:+.1f}"
    cells = (*("-" if seconds is None else f"{seconds:.1f}" for seconds in (a, b)), longer)
    return f"{name:{wide}}" + "".join(f"{cell:>9}" for cell in cells)
