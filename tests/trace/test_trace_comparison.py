"""Two traces are told apart by the first thing in which they differ."""

from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from recordings import EVENTS, Recording

from handeye.program.events import Event
from handeye.trace.channels import LOG
from handeye.trace.compare import Repetition, compared, first_difference
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace


def _changed(
    path: Path,
    *,
    event: int = -1,
    tick: int = -1,
    off: float = 1.0,
    last: int = len(EVENTS),
    **fields: object,
) -> Trace:
    """A trace of the run in which fields of the event or servo period of that number are others."""
    recording = Recording(path).begin()
    events, ticks = iter(range(99)), iter(range(99))
    write, sense = recording.recorder.event, recording.recorder.tick

    def altered(happened: Event) -> None:
        write(msgspec.structs.replace(happened, **fields) if next(events) == event else happened)

    recording.recorder.event = altered  # type: ignore[method-assign]
    recording.recorder.tick = lambda period: sense(  # type: ignore[method-assign]
        msgspec.structs.replace(period, effort=period.effort + off * (next(ticks) == tick))
    )
    recording.play(last=last).close()
    return read_trace(path)


@pytest.fixture
def whole(tmp_path: Path) -> Trace:
    return _changed(tmp_path / "a.mcap")


def test_a_trace_does_not_differ_from_one_of_the_same_run(tmp_path: Path, whole: Trace) -> None:
    assert first_difference(whole, _changed(tmp_path / "b.mcap")) is None


def test_how_a_trace_is_packed_makes_no_difference(
    tmp_path: Path, whole: Trace, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("handeye.trace.mcap_writer.CHUNK", 1000)
    other = _changed(tmp_path / "b.mcap")
    assert Path(other.name).read_bytes() != Path(whole.name).read_bytes()
    assert first_difference(whole, other) is None


def test_an_event_that_differs_is_named_with_what_is_different(tmp_path: Path, whole: Trace) -> None:
    other = _changed(tmp_path / "b.mcap", event=3, value=9.5)
    said = "event 4 differs: value of GuardTripped at 0.100 s is 9.0 in one trace, 9.5 in the other"
    assert first_difference(whole, other) == said


def test_a_servo_period_that_differs_is_named_with_what_happened_before(tmp_path: Path, whole: Trace) -> None:
    other = _changed(tmp_path / "b.mcap", tick=7)
    said = (
        "in servo period 8, at 0.133 s, torque of joint column differs: -219.474 oz in and -77.862 oz in, "
        "after event 4 (stopped: the hand presses with 32.4 ounces, over 28.8)"
    )
    assert first_difference(whole, other) == said


def test_a_trace_that_ends_before_the_other_is_named(tmp_path: Path, whole: Trace) -> None:
    other = _changed(tmp_path / "b.mcap", last=5)
    said = f"{other.name} ends and {whole.name} continues after event 5 (the hand is at (3.94, 7.87, 11.81) in, open"
    assert str(first_difference(whole, other)).startswith(said)
    assert str(first_difference(other, whole)).startswith(said)


def test_traces_can_be_compared_up_to_an_event(tmp_path: Path, whole: Trace) -> None:
    other = _changed(tmp_path / "b.mcap", event=19, last=25, line=99)
    assert first_difference(whole, other, events=19) is None
    assert str(first_difference(whole, other, events=20)).startswith("event 20 differs: line of StepStarted")


def test_last_places_of_numbers_are_told_from_where_runs_part(tmp_path: Path, whole: Trace) -> None:
    rounded = compared(whole, _changed(tmp_path / "b.mcap", tick=7, off=1e-13))
    assert rounded.parts is None
    assert str(rounded.rounded).startswith("in servo period 8, at 0.133 s, torque of joint column differs: ")
    both = compared(whole, _changed(tmp_path / "c.mcap", tick=7, off=1e-13, event=19, line=99))
    assert both.rounded == rounded.rounded
    assert str(both.parts).startswith("event 20 differs: line of StepStarted")
    parted = compared(whole, _changed(tmp_path / "d.mcap", tick=7, off=1e-3))
    assert parted.rounded is None
    assert "torque of joint column" in str(parted.parts)


def test_behind_other_versions_and_processors_the_motion_is_compared(tmp_path: Path, whole: Trace) -> None:
    made = {"versions": {"handeye": "9", "mujoco": "3"}, "processor": "a 6502"}
    assert compared(whole, _changed(tmp_path / "b.mcap", event=0, **made)) == Repetition()
    other = compared(whole, _changed(tmp_path / "c.mcap", event=0, tick=7, **made))
    assert str(other.parts).startswith("in servo period 8")
    elsewhere = compared(whole, _changed(tmp_path / "d.mcap", event=0, program="another", **made))
    assert str(elsewhere.parts).startswith("event 1 differs: ")


def test_a_sentence_that_its_event_does_not_say_is_a_difference(tmp_path: Path, whole: Trace) -> None:
    reworded = replace(
        whole, messages=[replace(m, data=m.data[:-1] + b"!") if m.topic == LOG else m for m in whole.messages]
    )
    assert (
        str(compared(whole, reworded).parts) == "event 1 differs: RunStarted at 0.000 s has a different text"
    )
