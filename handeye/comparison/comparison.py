"""The comparison of two runs as data. Text, JSON and page are made from these data."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

import msgspec

from handeye.comparison.findings import Corrections, Searches, Stops, corrections, searches, stops
from handeye.comparison.first import First, first_difference
from handeye.comparison.pairing import Place, TwoRuns, listing_of
from handeye.comparison.parting import DecidingEvent, Divergence, parting
from handeye.core.brief import Brief, Several
from handeye.core.entries import require
from handeye.core.errors import BadFile
from handeye.core.faults import Fault
from handeye.core.record import Record
from handeye.core.units import INCHES, Measures
from handeye.core.variation import WorldSpec
from handeye.program.events import RunStarted, StepStarted
from handeye.report.facts.again import written
from handeye.report.facts.outcome import Kind, outcome
from handeye.report.recorded import RecordedRun
from handeye.tasks import known, known_any
from handeye.tasks.interface import Task
from handeye.trace.sentences import renderer_name
from handeye.trace.stats import StageFigures, statistics

_NONE: Final = "none"
_DRAWN: Final = "as drawn"


class Condition(Record, frozen=True, kw_only=True):
    """A condition in which two runs differ, for example the seed."""

    what: str
    """Name of the condition: `task`, `plan`, `arm`, `camera`, a setting of the world such as `seed`, a quantity that
    the user set, `version of ...`, or `own ...`.
    """
    a: str
    b: str


def conditions(a: RunStarted, b: RunStarted) -> tuple[Condition, ...]:
    """Return the conditions in which two runs differ."""
    both = [dict(_conditions(begun)) for begun in (a, b)]
    drawn = {name: _DRAWN for begun in (a, b) for name in begun.world.overrides.set}
    names = dict.fromkeys(name for side in both for name in side)
    told = ((name, *(side.get(name, drawn.get(name, _NONE)) for side in both)) for name in names)
    return tuple(Condition(what=name, a=one, b=other) for name, one, other in told if one != other)


def _conditions(begun: RunStarted) -> Iterator[tuple[str, str]]:
    yield "task", begun.task
    yield "program", begun.program
    yield "plan", begun.plan
    yield "arm", f"{begun.arm} {begun.arm_digest}"
    yield from _world(begun)
    yield "camera", renderer_name(begun.camera)
    yield "missing senses", ", ".join(begun.lacking) or _NONE
    yield from ((f"own {part}", name) for part, name in begun.own_parts.items())
    yield from ((f"version of {name}", version) for name, version in begun.versions.items())


def _world(begun: RunStarted) -> Iterator[tuple[str, str]]:
    world, task = begun.world, known(begun.task)
    quantities = {} if task is None else task.variation().quantities
    yield "drawing of the world", f"{world.drawing}"
    yield "seed", f"{world.seed}"
    yield "level", world.level
    yield "switched off", ", ".join(world.overrides.without) or _NONE
    yield from ((name, written(quantities.get(name), value)) for name, value in world.overrides.set.items())
    yield from ((f"scale of {name}", f"{factor:g}") for name, factor in world.overrides.scale.items())
    yield from ((f"fault {fault.name}", _fault(task, world, fault)) for fault in world.faults)


def _fault(task: Task | None, world: WorldSpec, fault: Fault) -> str:
    """Return a fault in the form in which users type it. If the task is unknown, return the fault's name and value."""
    catalogue = None if task is None else task.faults(world)
    return str(fault) if catalogue is None or fault.name not in catalogue.kinds else catalogue.written(fault)


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedRun:
    """One of the compared runs."""

    name: str
    program: str
    world: str
    came_to: Kind
    seconds: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Stages:
    """A stage in both runs. `a` or `b` is None if this run did not reach the stage."""

    name: str
    a: StageFigures | None
    b: StageFigures | None

    @property
    def seconds(self) -> tuple[float | None, float | None]:
        """Duration of the stage in each run (s)."""
        a, b = (None if each is None else each.seconds for each in (self.a, self.b))
        return a, b


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Comparison(Brief):
    """The comparison of two runs, A and B."""

    a: ComparedRun
    b: ComparedRun
    measures: Measures  # display units
    conditions: tuple[Condition, ...]
    thinned: bool
    """True if either trace is thinned, that is, holds only some of the servo periods of its run. If a trace is
    thinned, the sensor values of servo periods are not compared.
    """
    first: First | None
    parted: Divergence | None
    searches: tuple[Searches, ...]  # the searches, each with the number of places that each run tried
    stops: tuple[Stops, ...]  # the guarded motions, each with how it ended in each run
    corrections: tuple[Corrections, ...]  # the saved differences and the located parts in each run
    stages: tuple[Stages, ...]

    @property
    def same(self) -> bool:
        """True if all recorded values are equal."""
        return self.first is None

    def __str__(self) -> str:
        from handeye.comparison.text import comparison_text

        return "\n".join(comparison_text(self))


def comparison(a: RecordedRun, b: RecordedRun) -> Comparison:
    """Compare two runs. Raises InvalidInput if the system of a run cannot compare runs, or if a trace is not
    valid."""
    for run in (a, b):
        name = run.trace.name
        require(run.trace.head.system, "compare", name)
        steps = len(listing_of(run).steps)
        if any(isinstance(event, StepStarted) and not 0 <= event.step < steps for event in run.trace.events):
            raise BadFile(f"the trace {name} has steps that are not in its plan")
    runs, task = TwoRuns(a, b), known_any(a.trace.head.task)
    one, other = ({stage.stage: stage for stage in statistics(run.trace.events, {}).stages} for run in (a, b))
    return Comparison(
        a=_compared(a),
        b=_compared(b),
        measures=INCHES if task is None else task.measures,
        conditions=conditions(a.trace.head, b.trace.head),
        thinned=runs.thinned,
        first=first_difference(runs),
        parted=parting(runs),
        searches=Several(searches(runs)),
        stops=Several(stops(runs)),
        corrections=Several(corrections(runs)),
        stages=Several(
            Stages(name=name, a=one.get(name), b=other.get(name)) for name in dict.fromkeys((*one, *other))
        ),
    )


def _compared(run: RecordedRun) -> ComparedRun:
    head = run.trace.head
    return ComparedRun(
        name=run.trace.name,
        program=head.program,
        world=str(head.world),
        came_to=outcome(run).kind,
        seconds=run.ends,
    )


def as_json(found: Comparison) -> dict[str, Any]:
    """Return a comparison as data for JSON."""
    first, parted = found.first, found.parted
    told = {
        "same": found.same,
        "a": found.a,
        "b": found.b,
        "conditions": found.conditions,
        "thinned": found.thinned,
        "first": None if first is None else _first(first),
        "parted": parted and {**_where(parted.place), "a": _turning(parted.a), "b": _turning(parted.b)},
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


def _turning(turning: DecidingEvent | None) -> dict[str, Any] | None:
    return None if turning is None else {"place": turning.place, "event": turning.event}


def _where(place: Place | None) -> dict[str, Any]:
    if place is None:
        return {"stage": None, "step": None, "file": None, "line": None}
    return {"stage": place.stage, "step": place.step, "file": place.file, "line": place.line}
