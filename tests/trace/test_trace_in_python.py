"""A trace as people use it from Python: stages, pictures, and what was sensed, as values and arrays."""

import re
from pathlib import Path

import msgspec
import numpy as np
import pytest
from msgspec.structs import replace
from recordings import HISTORY, Recording, record

from handeye.core.errors import InvalidInput
from handeye.execution.servo import ServoPeriod
from handeye.ports.workcell import Sensed
from handeye.program.guards import GuardKind
from handeye.touch.guards import ActiveGuard
from handeye.trace.channels import HAND
from handeye.trace.forces import Forces, recorded_forces
from handeye.trace.hand_message import decoded_channels, hand_message
from handeye.trace.reading import read_trace
from handeye.trace.records import RawMessage
from handeye.trace.trace import Trace

PERIODS = [moment for moment in HISTORY if isinstance(moment.what, Sensed)]


@pytest.fixture
def trace(tmp_path: Path) -> Trace:
    record(tmp_path / "short.mcap")
    return read_trace(tmp_path / "short.mcap")


def test_the_stages_are_told_with_their_times(trace: Trace) -> None:
    told = [(stage.name, round(stage.begin, 2), round(stage.end, 2), stage.status) for stage in trace.stages]
    assert told == [
        ("open", 0.0, 0.4, "done"),
        ("close", 0.4, 0.8, "done"),
        ("again", 0.8, 1.2, "done"),
    ]


def test_a_stage_that_was_broken_off_says_so(tmp_path: Path) -> None:
    Recording(tmp_path / "short.mcap").begin().play(last=5).close()
    (stage,) = read_trace(tmp_path / "short.mcap").stages
    assert (stage.status, round(stage.end, 6)) == ("broken off", 0.133333)


def test_the_pictures_are_a_sequence(trace: Trace) -> None:
    assert [(picture.name, round(picture.time, 2)) for picture in trace.pictures] == [("WIDE", 0.8)]


def test_poses_are_told_body_by_body_and_none_where_one_is_not_there(trace: Trace) -> None:
    assert [trace.at(time).poses.get("carrier") for time in trace.times] == [
        None if np.isnan(row[0]) else tuple(row.tolist()) for row in trace.poses["carrier"]
    ]
    assert trace.poses["finger"].shape == (len(trace.times), 7)


def test_a_trace_without_motion_has_empty_columns(tmp_path: Path) -> None:
    Recording(tmp_path / "short.mcap").begin().play(last=2).close()
    trace = read_trace(tmp_path / "short.mcap")
    assert [trace.times.shape, trace.gaps.shape, trace.forces().force.shape] == [(0,), (0,), (0, 3)]


def test_force_stands_beside_its_time_and_its_guard(trace: Trace) -> None:
    forces = trace.forces()
    guarded = [period.guarded for period in PERIODS]
    assert np.array_equal(forces.estimated, guarded)
    efforts = np.array([period.effort for period in PERIODS])
    assert np.allclose(forces.force[guarded], -efforts[guarded, :3], atol=1e-6)
    assert np.allclose(forces.moment[guarded], -efforts[guarded, 3:], atol=1e-6)
    assert set(forces.guard[guarded]) == {"force"}
    assert np.allclose(forces.value[guarded], efforts[guarded, 2], atol=1e-6)  # downwards
    assert set(forces.limit[guarded]) == {8.0}


@pytest.mark.parametrize(
    ("guard", "value"),
    [
        (ActiveGuard(guard=GuardKind.FORCE, limit=9.0, axis=np.array([0.0, -1.0, 0.0])), -2.0),
        (ActiveGuard(guard=GuardKind.AGAINST, limit=9.0, axis=np.array([1.0, 0.0, 0.0])), 1.0),
        (ActiveGuard(guard=GuardKind.MOMENT, limit=9.0, axis=np.array([0.0, 0.0, 1.0])), 6.0),
        (ActiveGuard(guard=GuardKind.TORQUE, limit=9.0), 0.75),
        (ActiveGuard(guard=GuardKind.TOUCH, limit=3.0), 2.0),
    ],
    ids=lambda given: given.guard.value if isinstance(given, ActiveGuard) else "",
)
def test_the_value_is_what_the_guard_looks_at(guard: ActiveGuard, value: float) -> None:
    sensed = replace(PERIODS[0].period.sensed, touch=(False, True), tool_torque=-0.75)
    period = ServoPeriod(sensed=sensed, effort=np.zeros(6), wrench=np.arange(1.0, 7.0), guards=(guard,))
    forces = recorded_forces(np.zeros(1), [RawMessage(HAND, 0, hand_message(period))])
    assert (forces.guard[0], forces.value[0], forces.limit[0]) == (guard.guard, value, guard.limit)


@pytest.mark.parametrize("width", [0, 2, 10**12])
def test_a_channel_has_as_many_values_as_it_says(width: int) -> None:
    with pytest.raises(msgspec.DecodeError, match="differs from the number that the channel declares"):
        decoded_channels(b'{"channels":[{"name":"range","width":%d,"values":[1.0]}]}' % width)


def test_where_nothing_is_estimated_there_are_no_figures(trace: Trace) -> None:
    forces = trace.forces()
    for column in (forces.force, forces.moment, forces.axis, forces.value, forces.limit):
        assert np.isnan(column[~forces.estimated]).all()
        assert not np.isnan(column[forces.estimated]).any()


def test_the_force_of_a_line_is_that_of_each_time_it_was_carried_out(trace: Trace) -> None:
    of_line = trace.forces(line=4)
    assert len(of_line.times) == 24
    assert of_line.times.min() > 0.4
    assert of_line.times.max() < 0.8 + 1e-6
    assert [len(motion.times) for motion in of_line.motions()] == [4, 4, 4]
    assert np.array_equal(trace.forces(line="4").times, of_line.times)


@pytest.mark.parametrize(("line", "below"), [(5, r"; the next line that ran is 6: .+"), (900, "")])
def test_a_line_that_was_not_carried_out_is_refused(trace: Trace, line: int, below: str) -> None:
    with pytest.raises(InvalidInput, match=rf"^line {line} of short did not run in .*short\.mcap{below}$"):
        trace.forces(line=line)


def test_the_manual_names_nothing_that_a_trace_does_not_have() -> None:
    manual = (Path(__file__).parents[2] / "docs" / "stepping.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", manual, re.DOTALL)
    named = set(re.findall(r"\b(?:trace|felt)\.(\w+)", manual.partition("### In Python")[2]))
    assert {"forces", "at", "frame"} <= set(re.findall(r"trace\.(\w+)", block)) <= named
    assert named <= {name for kind in (Trace, Forces) for name in (*dir(kind), *kind.__dataclass_fields__)}


def test_each_guarded_motion_can_be_had_by_itself(trace: Trace) -> None:
    motions = trace.forces().motions()
    assert len(motions) == 9
    assert all(motion.estimated.all() for motion in motions)
