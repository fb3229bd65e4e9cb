"""The first thing that was recorded otherwise is found beside the same step, whatever the clock says."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from compared_runs import block_start, kept
from foxglove_schemas_protobuf.JointStates_pb2 import JointStates
from report_pages import recorded

from handeye.comparison.comparison import comparison
from handeye.comparison.first import First, first_difference
from handeye.comparison.pairing import TwoRuns
from handeye.program.events import GuardTripped
from handeye.report.recorded import RecordedRun
from handeye.trace.channels import EVENTS, FRAMES, JOINTS, MOMENTS
from handeye.trace.reading import read_trace
from handeye.trace.records import RawMessage
from handeye.trace.thinning import write_thinned

LATE = 5_000_000_000
"""ns"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    return recorded(tmp_path_factory.mktemp("first") / "a.mcap")


def altered(run: RecordedRun, change: Callable[[int, RawMessage], RawMessage | None]) -> RecordedRun:
    """The run with its messages changed by their numbers, or left out."""
    messages = (change(number, message) for number, message in enumerate(run.trace.messages))
    kept = tuple(message for message in messages if message is not None)
    return replace(run, trace=replace(run.trace, messages=kept))


def late(message: RawMessage) -> RawMessage:
    """The message, some seconds later by the clock."""
    data = message.data
    if message.topic == JOINTS:
        joints = JointStates.FromString(data)
        joints.timestamp.seconds += LATE // 10**9
        data = joints.SerializeToString()
    return replace(message, time=message.time + LATE, data=data)


def first(a: RecordedRun, b: RecordedRun) -> First:
    found = first_difference(TwoRuns(a, b))
    assert found is not None
    return found


def test_a_run_that_began_later_by_the_clock_is_the_same(run: RecordedRun) -> None:
    assert first_difference(TwoRuns(run, altered(run, lambda _, message: late(message)))) is None


def test_a_step_that_went_on_later_differs_in_its_time(run: RecordedRun) -> None:
    periods = [number for number, message in enumerate(run.trace.messages) if message.topic == JOINTS]
    paused = altered(run, lambda number, message: message if number < periods[2] else late(message))
    found = first(run, paused)
    assert found.differing.quantity == ("time",)
    assert found.differing.b - found.differing.a == pytest.approx(LATE / 1e9)
    assert found.period == 3


def test_a_body_that_moved_in_one_run_alone_is_named(run: RecordedRun) -> None:
    moves = [number for number, message in enumerate(run.trace.messages) if message.topic == FRAMES]
    still = altered(run, lambda number, message: None if number == moves[2] else message)
    for a, b in ((run, still), (still, run)):
        found = first(a, b)
        assert found.differing.name == "body.finger.place.x"
        assert [found.differing.a, found.differing.b].index(None) == (b is still)
        assert found.period == 2


def test_what_happened_next_is_named_where_the_other_run_went_on(run: RecordedRun) -> None:
    events = [number for number, message in enumerate(run.trace.messages) if message.topic == EVENTS]
    trip = next(n for n, event in enumerate(run.trace.events) if isinstance(event, GuardTripped))
    went_on = altered(run, lambda number, message: None if number == events[trip] else message)
    told = run.trace.events[:trip] + run.trace.events[trip + 1 :]
    found = first(run, replace(went_on, trace=replace(went_on.trace, events=told)))
    assert (found.differing.name, found.differing.a, found.differing.b) == ("event", "GuardTripped", None)
    assert found.next == (run.trace.events[trip], None)
    assert found.period == 6


def test_what_was_not_recorded_before_a_run_was_taken_up_makes_no_difference(run: RecordedRun) -> None:
    events = [number for number, message in enumerate(run.trace.messages) if message.topic == EVENTS]

    def forgotten(number: int, message: RawMessage) -> RawMessage | None:
        return None if message.topic in MOMENTS and number < events[6] else message

    taken_up = altered(run, forgotten)
    assert taken_up.trace.unseen > 1
    assert first_difference(TwoRuns(run, taken_up)) is None
    assert first_difference(TwoRuns(taken_up, run)) is None


@pytest.mark.slow
def test_a_line_that_nobody_comes_to_makes_no_difference(tmp_path: Path) -> None:
    script = 'STAGE "open"\nOPEN 1\nJUMP ON\n{}ON: OPEN 1.2\n'
    a, b = (
        kept(tmp_path / name, block_start(script.format(more)))
        for name, more in (("a", ""), ("b", "OPEN 2\n"))
    )
    found = comparison(a, b)
    assert found.same
    assert found.parted is None
    assert [condition.what for condition in found.conditions] == ["plan"]


def test_a_thinned_trace_is_compared_by_what_happened(run: RecordedRun, tmp_path: Path) -> None:
    write_thinned(run.trace, tmp_path / "thin.mcap")
    thin = RecordedRun(trace=read_trace(tmp_path / "thin.mcap"))
    assert len(thin.trace.times) < len(run.trace.times)
    for found in (comparison(run, thin), comparison(thin, run), comparison(thin, thin)):
        assert found.same
        assert found.thinned
        assert "At least one trace is thinned: events are compared" in str(found)
    assert not comparison(run, run).thinned
