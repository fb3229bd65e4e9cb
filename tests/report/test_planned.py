"""Ends of motions are told with why they are where they are, and moved goals with what moved them."""

from dataclasses import replace

import msgspec
import numpy as np
import pytest
from report_pages import recorded
from short_runs import plan_of

from handeye.planfile.store import encode
from handeye.program import events as happened
from handeye.program.diagnosis.causes import PlacesTried
from handeye.program.events import AnyEvent
from handeye.report.facts.planned import EndReason, Mover, corrections, ends, searches
from handeye.report.recorded import RecordedRun


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    return recorded(tmp_path_factory.mktemp("run") / "trace.mcap")


def of(run: RecordedRun, *events: AnyEvent) -> RecordedRun:
    """The run with these events behind its beginning."""
    return replace(run, trace=replace(run.trace, events=(*run.trace.events[:2], *events)))


def step(*within: AnyEvent, off: float = 0.0, line: int = 2, text: str = "MOVE P1") -> list[AnyEvent]:
    """A step that ends so far off its plan, m."""
    finished = happened.StepFinished(
        time=12.0, step=0, hand=(0.1 + off, 0.2, 0.3), planned=(0.1, 0.2, 0.3), gap=0.0
    )
    return [happened.StepStarted(time=11.0, step=0, line=line, text=text), *within, finished]


SAVED = happened.Saved(time=11.5, name="E1", difference=(0.001, 0.0, 0.0))
RESTORED = happened.Restored(time=12.0, name="E1", goal="P1", difference=(0.001, 0.0, 0.0))
ADJUSTED = happened.Adjusted(time=12.0, goal="P1", shift=(0.001, 0.0, 0.0))
TRIPPED = happened.GuardTripped(time=11.5, guard="force", value=9.0, limit=8.0)


def test_an_end_says_why_it_is_where_it_is(run: RecordedRun) -> None:
    events = [*step(), *step(ADJUSTED, off=0.001), *step(off=0.001), *step(TRIPPED, off=0.01)]
    told = ends(of(run, *events))
    assert [end.why for end in told] == [
        EndReason.PLANNED,
        EndReason.MOVED,
        EndReason.CARRIED,
        EndReason.GUARD,
    ]
    assert np.allclose([end.off for end in told], [0, 0.001, 0.001, 0.01])


def test_a_moved_goal_names_the_save_that_moved_it(run: RecordedRun) -> None:
    events = [*step(SAVED, line=5, text="SAVE E1"), *step(RESTORED, ADJUSTED, line=9)]
    (moved,) = corrections(of(run, *events))
    (cause,) = moved.causes
    assert (moved.goal, moved.step.line, cause.name, cause.place, cause.by) == (
        "P1",
        9,
        "E1",
        "5",
        Mover.SAVE,
    )


SEARCHING = """
        STAGE   "seek"
        SEARCH  .07
AGAIN:  MOVE    P1
        AOJ     AGAIN
        SEARCH  .07
        MOVE    P2
"""


SEARCHING_PART = SEARCHING.replace("P1", "A")


def numbered(events: list[AnyEvent], step: int) -> list[AnyEvent]:
    """The events of a step of another number."""
    return [
        msgspec.structs.replace(event, step=step) if hasattr(event, "step") else event for event in events
    ]


def test_a_moved_goal_names_the_place_of_the_search_that_moved_it(run: RecordedRun) -> None:
    seeking = replace(run, trace=replace(run.trace, plan=encode(plan_of(SEARCHING)).encode()))
    shift = happened.Adjusted(time=12.0, goal="P1", shift=(0.001, 0.0, 0.0))
    sent = numbered(step(advanced(1), line=5, text="AOJ AGAIN"), 2)
    events = [*numbered(step(), 0), *sent, *numbered(step(shift, line=4), 1)]
    anew = [*numbered(step(), 3), *numbered(step(shift, line=7), 4)]
    first, second = corrections(of(seeking, *events, *anew))
    assert [(cause.name, cause.by, cause.place) for cause in first.causes] == [("place 2", Mover.SEARCH, "5")]
    assert second.causes == ()


def test_a_look_is_named_only_for_what_the_search_does_not_explain(run: RecordedRun) -> None:
    seeking = replace(run, trace=replace(run.trace, plan=encode(plan_of(SEARCHING_PART)).encode()))
    seen = happened.PartSeen(time=11.5, part="BASE", x=0.0, y=0.0, yaw=0.0)
    sent = numbered(step(seen, advanced(1), line=5), 2)
    shifts = ((0.001, 0.0, 0.0), (0.021, 0.0, 0.0))
    moves = [
        event
        for shift in shifts
        for event in numbered(step(happened.Adjusted(time=12.0, goal="A", shift=shift)), 1)
    ]
    by_search, by_both = corrections(of(seeking, *numbered(step(), 0), *sent, *moves))
    assert [cause.by for cause in by_search.causes] == [Mover.SEARCH]
    assert [cause.by for cause in by_both.causes] == [Mover.LOOK, Mover.SEARCH]


def advanced(count: int) -> AnyEvent:
    return happened.SearchAdvanced(time=11.0 + count, count=count, offset=(0.001 * count, 0.0))


def test_a_search_holds_its_places_from_the_first_on(run: RecordedRun) -> None:
    (found,) = searches(of(run, *step(advanced(1)), *step(advanced(2))))
    assert found.places == ((0.0, 0.0), (0.001, 0.0), (0.002, 0.0))
    assert not found.exhausted


def test_a_search_that_begins_anew_is_another(run: RecordedRun) -> None:
    found = searches(of(run, *step(advanced(1)), *step(advanced(2)), *step(advanced(1))))
    assert [len(search.places) for search in found] == [3, 2]


def test_a_search_without_an_end_says_so(run: RecordedRun) -> None:
    gone = happened.ErrorRaised(time=14.0, number=6, cause=PlacesTried(places=2))
    (found,) = searches(of(run, *step(advanced(1)), *step(gone)))
    assert found.exhausted
