"""The comparison of two runs as facts, from which text, JSON and page are made."""

from dataclasses import dataclass
from typing import Any

import msgspec

from handeye.comparison.conditions import Condition, conditions
from handeye.comparison.findings import Corrections, Searches, Stops, corrections, searches, stops
from handeye.comparison.first import First, first_difference
from handeye.comparison.pairing import Place, TwoRuns, listing_of
from handeye.comparison.parting import Parting, Turning, parting
from handeye.core.entries import require
from handeye.core.errors import BadFile
from handeye.core.units import INCHES, Measures
from handeye.program.events import StepStarted
from handeye.report.facts.outcome import Kind, outcome
from handeye.report.recorded import RecordedRun
from handeye.tasks import known_any
from handeye.trace.stats import StageFigures, statistics


@dataclass(frozen=True, slots=True, kw_only=True)
class Compared:
    """One of the compared runs."""

    name: str
    """Its file."""
    program: str
    world: str
    """Its seed, and what is said of it."""
    came_to: Kind
    seconds: float
    """How long it took, simulated."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stages:
    """The same stage in two runs; None where it was not reached."""

    name: str
    a: StageFigures | None
    b: StageFigures | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """Two runs beside each other."""

    a: Compared
    """The first run."""
    b: Compared
    """The second."""
    measures: Measures
    """Units in which people read the first difference."""
    conditions: tuple[Condition, ...]
    """Differing conditions."""
    thinned: bool
    """A trace is thinned to some of its servo periods, whose sensor values are then not compared."""
    first: First | None
    """The first recorded difference, if any."""
    parted: Parting | None
    """Where they diverged, if anywhere."""
    searches: tuple[Searches, ...]
    """Places that each search tried."""
    stops: tuple[Stops, ...]
    """Ends of guarded motions."""
    corrections: tuple[Corrections, ...]
    """Saved differences, and located parts."""
    stages: tuple[Stages, ...]
    """Figures of each stage."""

    @property
    def same(self) -> bool:
        """True if nothing that was recorded of both differs."""
        return self.first is None

    def __str__(self) -> str:
        from handeye.comparison.text import comparison_text

        return "\n".join(comparison_text(self))


def comparison(a: RecordedRun, b: RecordedRun) -> Comparison:
    """Compare two runs; raises an InvalidInput if one follows no plan, or its trace cannot be understood."""
    for run in (a, b):
        _check(run)
    runs, task = TwoRuns(a, b), known_any(a.trace.head.task)
    return Comparison(
        a=_compared(a),
        b=_compared(b),
        measures=INCHES if task is None else task.measures,
        conditions=conditions(a.trace.head, b.trace.head),
        thinned=runs.thinned,
        first=first_difference(runs),
        parted=parting(runs),
        searches=searches(runs),
        stops=stops(runs),
        corrections=corrections(runs),
        stages=_stages(a, b),
    )


def _check(run: RecordedRun) -> None:
    """Raises an InvalidInput if a run follows no plan, or has steps that its plan lacks."""
    name = run.trace.name
    require(run.trace.head.system, "compare", name)
    steps = len(listing_of(run).steps)
    if any(isinstance(event, StepStarted) and not 0 <= event.step < steps for event in run.trace.events):
        raise BadFile(f"{name} tells of steps that its plan lacks")


def _compared(run: RecordedRun) -> Compared:
    head = run.trace.head
    return Compared(
        name=run.trace.name,
        program=head.program,
        world=str(head.world),
        came_to=outcome(run).kind,
        seconds=run.ends,
    )


def _stages(a: RecordedRun, b: RecordedRun) -> tuple[Stages, ...]:
    """Stages of two runs, in order of their start."""
    one, other = ({stage.stage: stage for stage in statistics(run.trace.events, {}).stages} for run in (a, b))
    return tuple(
        Stages(name=name, a=one.get(name), b=other.get(name)) for name in dict.fromkeys((*one, *other))
    )


def as_json(found: Comparison) -> dict[str, Any]:
    """A comparison as data."""
    first, parted = found.first, found.parted
    told = {
        "same": found.same,
        "a": found.a,
        "b": found.b,
        "conditions": found.conditions,
        "thinned": found.thinned,
        "first": None if first is None else _first(first),
        "parted": None if parted is None else _parted(parted),
        "searches": found.searches,
        "stops": found.stops,
        "corrections": found.corrections,
        "stages": found.stages,
    }
    data: dict[str, Any] = msgspec.to_builtins(told)
    return data


def _first(first: First) -> dict[str, Any]:
    differing = first.differing
    return {
        **_where(first.place),
        "quantity": differing.name,
        "unit": differing.unit,
        "a": differing.a,
        "b": differing.b,
        "period": first.period,
        "places": (first.a, first.b),
    }


def _parted(parted: Parting) -> dict[str, Any]:
    return {**_where(parted.place), "a": _turning(parted.a), "b": _turning(parted.b)}


def _turning(turning: Turning | None) -> dict[str, Any] | None:
    return None if turning is None else {"place": turning.place, "event": turning.event}


def _where(place: Place | None) -> dict[str, Any]:
    if place is None:
        return {"stage": None, "step": None, "file": None, "line": None}
    return {"stage": place.stage, "step": place.step, "file": place.file, "line": place.line}
