"""Describes the comparison of two runs in text, in the units of the arm language."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Final

from handeye.comparison.comparison import ComparedRun, Comparison, Condition
from handeye.comparison.findings import Correction, Corrections, Search, Searches, Stop, Stops
from handeye.comparison.first import EVENT, First
from handeye.comparison.pairing import Place
from handeye.comparison.parting import DecidingEvent, Divergence
from handeye.core.plain_text import counted, one_line
from handeye.core.units import DEGREE, INCH, UNITS, Measures
from handeye.program.events import AnyEvent, StepStarted
from handeye.program.guards import GuardKind
from handeye.report.facts.outcome import Kind
from handeye.trace.account import ASTRAY
from handeye.trace.quantities import quantity_text, values_text
from handeye.trace.sentences import inches, sentence

_CAME_TO: Final[dict[Kind, str]] = {
    "right": "finished, and the work is right",
    "wrong": "finished, and the work is wrong",
    "ended": "finished",
    "stopped": "stopped and called the operator",
    "panic": "was stopped by the panic button",
    "paused": "has not finished",
    "broken off": "was recorded only in part",
}
THINNED: Final = (
    "At least one trace is thinned: events are compared, but not the sensor readings between the events."
)
COURSE: Final = "Both runs took the same course: the same steps, stops, errors and answers."
_UNITS: Final[Mapping[GuardKind, str]] = {
    GuardKind.FORCE: "oz",
    GuardKind.AGAINST: "oz",
    GuardKind.MOMENT: "oz in",
    GuardKind.TORQUE: "oz in",
}


def same_words(found: Comparison) -> str:
    """Say in a sentence that two runs are equal, and how closely they were compared."""
    return (
        "Both runs recorded the same events."
        if found.thinned
        else "Both runs are identical, to the last bit."
    )


def heading_words(found: Comparison) -> str:
    """Say the result of a comparison in one sentence."""
    if found.same:
        return same_words(found)
    if found.parted is None:
        return "Both runs took the same course."
    if found.a.came_to != found.b.came_to:
        return f"A {_CAME_TO[found.a.came_to]}; B {_CAME_TO[found.b.came_to]}."
    place = found.parted.place
    return f"A and B diverge {'before the first step' if place is None else f'in the stage “{place.stage}”'}."


def run_words(run: ComparedRun) -> str:
    """Describe a run and its outcome in words."""
    return f"{run.name}: {run.program}, {run.world}, {run.seconds:.1f} s: {_CAME_TO[run.came_to]}"


def moment_words(first: First) -> str:
    """Say in words in which step and in which servo period a difference lies."""
    period = "" if first.period is None else f", servo period {first.period}"
    return f"{place_words(first.place)}{period}"


def first_words(first: First, measures: Measures) -> tuple[str, ...]:
    """Name the quantity that differs, with both values, or the next event of each run."""
    if first.differing.quantity == EVENT:
        return f"A: {_next(first.next[0])}", f"B: {_next(first.next[1])}"
    one, other = values_text(first.differing, measures)
    return (f"{quantity_text(first.differing.quantity)}: A {one}, B {other}",)


def _next(event: AnyEvent | None) -> str:
    return "no event there" if event is None else sentence(event)


def turning_words(turning: DecidingEvent | None) -> str:
    """Describe in words the event that decides how a run continues."""
    if turning is None:
        return "has finished"
    if isinstance(turning.event, StepStarted):
        return f"continues at line {turning.event.place}: {one_line(turning.event.text)}"
    return sentence(turning.event)


def place_words(place: Place | None) -> str:
    """Name a step in words."""
    if place is None:
        return "before the first step"
    return f"{place.stage}, line {place.name}: {one_line(place.text)}"


def search_words(search: Search) -> str:
    """Say in words how many places a search tried."""
    return counted(search.places, "place") + (", all of them" if search.exhausted else "")


def stop_words(stop: Stop) -> str:
    """Say in words how a guarded motion ended."""
    if stop.guard is None or stop.value is None:
        return "not stopped"
    unit = _UNITS.get(stop.guard)
    told = "" if unit is None else f" at {stop.value / UNITS[unit].size:.1f} {unit}"
    return f"stopped by {stop.guard.value}{told}"


def correction_words(found: Correction) -> str:
    """Describe a correction in words."""
    turned = "" if found.yaw is None else f", turned {found.yaw / DEGREE:.1f} deg"
    return f"{inches(found.at)}{turned}"


_BOTH: Final = ("A", "B")


def comparison_text(found: Comparison) -> list[str]:
    """Return a comparison as lines of text."""
    runs = [f"{letter}  {run_words(run)}" for letter, run in zip(_BOTH, (found.a, found.b), strict=True)]
    lines = [*runs, *_conditions(found.conditions), *([THINNED] if found.thinned else [])]
    if found.first is None:
        return [*lines, "", same_words(found)]
    sections = (
        _first(found.first, found.measures),
        _parted(found.parted),
        _unlike("Searches", "tried the same number of places", found.searches, search_words),
        _unlike("Guarded motions", "ended in the same way", found.stops, stop_words),
        _corrected(found.corrections),
        _took(found),
    )
    return [*lines, *(line for section in map(tuple, sections) if section for line in ("", *section))]


def _conditions(differing: Sequence[Condition]) -> Iterator[str]:
    """Yield, as lines of text, the conditions that differ. If the plans differ, a note says that only common steps
    are compared.
    """
    for each in differing:
        if each.what == "plan":
            yield (
                "The plans differ, so only the steps that occur in both runs are compared. `handeye diff` compares "
                "plans."
            )
        else:
            yield f"{each.what}: {each.a} in A, {each.b} in B"


# -- the first difference --------------------------------------------------------------------------------------


def _first(first: First, measures: Measures) -> Iterator[str]:
    yield f"First difference: {moment_words(first)}"
    yield from (f"  {line}" for line in first_words(first, measures))


def _parted(parted: Divergence | None) -> Iterator[str]:
    if parted is None:
        yield COURSE
        return
    yield f"The runs diverge: {place_words(parted.place)}"
    yield f"  A: {turning_words(parted.a)}"
    yield f"  B: {turning_words(parted.b)}"


# -- what each searched, felt and corrected ------------------------------------------------------------------------


def _unlike(
    what: str, alike: str, found: Sequence[Searches | Stops], words: Callable[[Any], str]
) -> Iterator[str]:
    yield from _counted(what, alike, found)
    for each in found:
        if each.a is not None and each.b is not None and not each.alike:
            yield f"  {place_words(each.a.place)}: A {words(each.a)}, B {words(each.b)}"


def _corrected(found: Sequence[Corrections]) -> Iterator[str]:
    yield from _counted("Corrections", f"within {ASTRAY / INCH:.2f} in of each other", found)
    for each in found:
        if each.a is not None and each.b is not None and each.apart is not None and not each.alike:
            told = f"{each.a.name} in A {correction_words(each.a)}, in B {correction_words(each.b)}"
            yield f"  {place_words(each.a.place)}: {told}: {each.apart / INCH:.2f} in apart"


def _counted(what: str, alike: str, found: Sequence[Searches | Stops | Corrections]) -> Iterator[str]:
    """Yield a line with the number of findings that occur in both runs, and the number of these findings that are
    alike. Yields nothing if there are no findings.
    """
    both = [each for each in found if each.a is not None and each.b is not None]
    if found:
        counts = sum(each.b is None for each in found), sum(each.a is None for each in found)
        alone = "".join(f"; {n} in {letter} alone" for letter, n in zip(_BOTH, counts, strict=True) if n)
        yield f"{what}: {len(both)} in both, {sum(each.alike for each in both)} {alike}{alone}"


# -- what they took --------------------------------------------------------------------------------------------


def _took(found: Comparison) -> Iterator[str]:
    """Yield a row for each stage, and a row for the total. A row gives the simulated seconds of run A, those of run B,
    and the difference.
    """
    wide = max(map(len, ("Seconds", *(stage.name for stage in found.stages))))
    yield f"{'Seconds':{wide}}{'A':>9}{'B':>9}{'B - A':>9}"
    for stage in found.stages:
        yield _row(stage.name, wide, *stage.seconds)
    yield _row("all", wide, found.a.seconds, found.b.seconds)


def _row(name: str, wide: int, a: float | None, b: float | None) -> str:
    longer = "" if a is None or b is None else f"{b - a:+z.1f}"
    cells = (*("-" if seconds is None else f"{seconds:.1f}" for seconds in (a, b)), longer)
    return f"{name:{wide}}" + "".join(f"{cell:>9}" for cell in cells)
