"""Words for the findings of a comparison, in the units of the arm language."""

from collections.abc import Mapping
from typing import Final

from handeye.comparison.comparison import ComparedRun, Comparison
from handeye.comparison.findings import Correction, Search, Stop
from handeye.comparison.first import EVENT, First
from handeye.comparison.pairing import Place
from handeye.comparison.parting import DecidingEvent
from handeye.core.plain_text import counted, one_line
from handeye.core.units import DEGREE, UNITS, Measures
from handeye.program.events import AnyEvent, StepStarted
from handeye.program.guards import GuardKind
from handeye.report.facts.outcome import Kind
from handeye.trace.quantities import quantity_text, values_text
from handeye.trace.sentences import inches, sentence

_CAME_TO: Final[dict[Kind, str]] = {
    "right": "it ended, and the work is right",
    "wrong": "it ended, and the work is not right",
    "ended": "it came to its end",
    "stopped": "it stopped and called the operator",
    "panic": "the panic button was hit",
    "paused": "it stands before its end",
    "broken off": "its trace was cut short",
}
THINNED: Final = "A trace is thinned: what happened is compared, not what was sensed in between."
_UNITS: Final[Mapping[GuardKind, str]] = {
    GuardKind.FORCE: "oz",
    GuardKind.AGAINST: "oz",
    GuardKind.MOMENT: "oz in",
    GuardKind.TORQUE: "oz in",
}


def same_words(found: Comparison) -> str:
    """That two runs did the same, and how exactly."""
    return "both did the same." if found.thinned else "both did the same, to the last bit."


def run_words(run: ComparedRun) -> str:
    """A run, and its outcome."""
    return f"{run.name}: {run.program}, {run.world}, {run.seconds:.1f} s: {_CAME_TO[run.came_to]}"


def moment_words(first: First) -> str:
    """The step of a difference, and the servo period."""
    period = "" if first.period is None else f", servo period {first.period}"
    return f"{place_words(first.place)}{period}"


def first_words(first: First, measures: Measures) -> tuple[str, ...]:
    """The differing quantity with both values, or the next events of both."""
    if first.differing.quantity == EVENT:
        return f"A: {_next(first.next[0])}", f"B: {_next(first.next[1])}"
    one, other = values_text(first.differing, measures)
    return (f"{quantity_text(first.differing.quantity)}: A {one}, B {other}",)


def _next(event: AnyEvent | None) -> str:
    return "no event there" if event is None else sentence(event)


def turning_words(turning: DecidingEvent | None) -> str:
    """How a run continued."""
    if turning is None:
        return "it has ended"
    if isinstance(turning.event, StepStarted):
        return f"it goes on at line {turning.event.place}: {one_line(turning.event.text)}"
    return sentence(turning.event)


def place_words(place: Place | None) -> str:
    """A step for people."""
    if place is None:
        return "before the first step"
    return f"{place.stage}, line {place.name}: {one_line(place.text)}"


def search_words(search: Search) -> str:
    """The number of places a search tried."""
    return counted(search.places, "place") + (", all of them" if search.exhausted else "")


def stop_words(stop: Stop) -> str:
    """How a guarded motion ended."""
    if stop.guard is None or stop.value is None:
        return "was not stopped"
    unit = _UNITS.get(stop.guard)
    told = "" if unit is None else f" at {stop.value / UNITS[unit].size:.1f} {unit}"
    return f"was stopped by {stop.guard.value}{told}"


def correction_words(found: Correction) -> str:
    """A correction in words."""
    turned = "" if found.yaw is None else f", turned {found.yaw / DEGREE:.1f} deg"
    return f"{inches(found.at)}{turned}"
