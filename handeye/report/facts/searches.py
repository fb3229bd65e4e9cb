"""The searches of a run: the places that each tried, about the first."""

from collections.abc import Iterator
from dataclasses import dataclass

from handeye.program.diagnosis.causes import PlacesTried
from handeye.program.events import AnyEvent, ErrorRaised, SearchAdvanced, StepStarted
from handeye.report.recorded import RecordedRun


@dataclass(frozen=True, slots=True, kw_only=True)
class Search:
    """A search that went on from its first place."""

    step: StepStarted
    """The step that sent it on last."""
    times: tuple[float, ...]
    """When it went on, s since the run began."""
    places: tuple[tuple[float, float], ...]
    """All of them, from the first on: x and y from the first, m."""
    exhausted: bool
    """It ran out of places; else it went on from the last."""


def searches(run: RecordedRun) -> tuple[Search, ...]:
    """The searches that went on, in order."""
    return tuple(_search(run, tries) for tries in _tries(run.trace.events))


def _tries(events: tuple[AnyEvent, ...]) -> Iterator[list[tuple[StepStarted, AnyEvent]]]:
    """The steps that went on in a search, with what came of it, search by search."""
    step: StepStarted | None = None
    tries: list[tuple[StepStarted, AnyEvent]] = []
    for event in events:
        if isinstance(event, StepStarted):
            step = event
        if step is None or not _is_try(event):
            continue
        if isinstance(event, SearchAdvanced) and event.count == 1 and tries:
            yield tries
            tries = []
        tries.append((step, event))
    if tries:
        yield tries


def _is_try(event: AnyEvent) -> bool:
    return isinstance(event, SearchAdvanced) or (
        isinstance(event, ErrorRaised) and isinstance(event.cause, PlacesTried)
    )


def _search(run: RecordedRun, tries: list[tuple[StepStarted, AnyEvent]]) -> Search:
    gone_on = [event for _, event in tries if isinstance(event, SearchAdvanced)]
    return Search(
        step=tries[-1][0],
        times=tuple(run.seconds(event.time) for event in gone_on),
        places=((0.0, 0.0), *(event.offset for event in gone_on)),
        exhausted=isinstance(tries[-1][1], ErrorRaised),
    )
