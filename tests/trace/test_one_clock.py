"""One number, one moment: whatever shows a run counts its time from the beginning of the program."""

import re
from pathlib import Path

import numpy as np
import pytest
from recordings import EVENTS, record

from handeye.program.events import GuardTripped, StepStarted
from handeye.report.facts.felt import guarded_motions
from handeye.report.facts.seen import seen_pictures
from handeye.report.facts.told import told
from handeye.report.recorded import RecordedRun
from handeye.trace.account import account
from handeye.trace.plot import plot
from handeye.trace.reading import read_trace
from handeye.trace.stats import statistics
from handeye.trace.trace import Trace


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    path = tmp_path_factory.mktemp("clock") / "short.mcap"
    record(path)
    return read_trace(path)


def test_every_view_of_a_run_begins_at_zero_and_ends_at_its_end(trace: Trace) -> None:
    end = EVENTS[-1].time
    drawn, run = plot(trace), RecordedRun(trace=trace)
    joints, events = trace.table("joints"), trace.table("events")
    assert trace.head.time == trace.begins == run.begins == drawn.begin == 0.0
    assert run.ends == drawn.end == trace.covers[1] == pytest.approx(end, abs=1e-6)
    for times in (trace.times, trace.forces().times, joints["time"], drawn.panels[0].curves[0].times):
        assert np.array_equal(times, trace.times)
    assert events["time"].tolist() == [event.time for event in EVENTS]
    assert sum(stage.seconds for stage in statistics(trace.events, {}).stages) == pytest.approx(end)


def test_a_guard_trips_at_one_time_wherever_it_is_told(trace: Trace) -> None:
    tripped = [event for event in EVENTS if isinstance(event, GuardTripped)][4]
    begun = [event.time for event in EVENTS if isinstance(event, StepStarted) and event.time < tripped.time][
        -1
    ]
    run = RecordedRun(trace=trace)
    assert tripped.time in next(mark.times for mark in plot(trace).marks if mark.name == "stop")
    assert tripped.time in [motion.trip.time for motion in guarded_motions(run) if motion.trip is not None]
    assert tripped.time in [each.time for each in told(run)]
    assert any(re.match(rf" *{begun:.2f} ", line) for line in account(EVENTS))
    step = trace.at(tripped.time).step
    assert step is not None
    assert step.time == begun


def test_a_picture_has_one_time(trace: Trace, tmp_path: Path) -> None:
    (taken,), (seen,) = trace.pictures, seen_pictures(RecordedRun(trace=trace))
    assert taken.time == seen.time
    assert trace.at(taken.time).picture is taken
