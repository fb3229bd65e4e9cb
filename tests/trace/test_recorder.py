"""A trace holds what counted, whatever happened to the program that wrote it."""

import errno
import multiprocessing
import os
import signal
from pathlib import Path

import numpy as np
import pytest
from recordings import BOUNDARIES, EVENTS, HISTORY, PLAN, Recording, between, record, started

from handeye.core.errors import InvalidInput
from handeye.ports.workcell import Sensed
from handeye.program.events import StepStarted, WentBack
from handeye.trace import mcap_writer
from handeye.trace.compare import first_difference
from handeye.trace.reading import read_trace
from handeye.trace.replay import moves

PERIOD = next(moment.period for moment in HISTORY if isinstance(moment.what, Sensed))
FULL = r"^.*short\.mcap.* cannot be written: No space left on device$"


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A place for a trace whose chunks are so small that each stage has several."""
    monkeypatch.setattr(mcap_writer, "CHUNK", 3000)
    return tmp_path / "short.mcap"


@pytest.fixture
def uninterrupted(path: Path) -> bytes:
    """The trace of a run that was never broken off."""
    return record(path.with_name("whole.mcap"))


# -- what is in it ----------------------------------------------------------------------------------------


def test_a_trace_holds_every_event_and_the_plan(path: Path) -> None:
    record(path)
    trace = read_trace(path)
    assert (trace.head, list(trace.events), trace.plan) == (EVENTS[0], EVENTS, PLAN)


def test_a_trace_holds_what_was_sensed_at_each_servo_period(path: Path) -> None:
    record(path)
    sensed = [(moment.what, moment.effort) for moment in HISTORY if isinstance(moment.what, Sensed)]
    trace = read_trace(path)
    assert trace.times == pytest.approx([there.time for there, _ in sensed], abs=1e-6)
    assert np.array_equal(trace.joints, [there.q for there, _ in sensed])
    assert np.array_equal(trace.rates, [there.qd for there, _ in sensed])
    assert np.array_equal(trace.efforts, [effort for _, effort in sensed])
    assert np.array_equal(trace.gaps, [there.gap for there, _ in sensed])


def test_a_trace_holds_the_pictures_with_all_their_levels(path: Path) -> None:
    record(path)
    (taken,) = read_trace(path).pictures
    (there,) = [moment for moment in HISTORY if moment.picture is not None]
    assert (taken.name, taken.time) == ("WIDE", there.what.time)
    assert np.array_equal(taken.picture, there.picture)


def test_between_the_starts_of_steps_only_frames_that_moved_are_written(path: Path) -> None:
    record(path)
    (_, first), (_, second), *_ = moves(read_trace(path).messages)
    assert set(first) == {"base", "finger", "screw"}
    assert set(second) == {"finger"}


def test_a_part_that_is_put_away_is_written_when_it_goes_and_then_only_where_a_step_begins(
    path: Path,
) -> None:
    record(path)
    trace = read_trace(path)
    begun = [event.time for event in trace.events if isinstance(event, StepStarted)]
    moved = list(moves(trace.messages))
    goes, *later = [row for row, poses in moved if poses.get("screw", (0, 0, 0))[2] < -1]
    assert len(later) == len([time for time in begun if time > trace.times[goes]])
    carrier = [row for row, poses in moved if "carrier" in poses]
    assert carrier[0] == 46  # what takes its place, in the middle of a step


def test_equal_runs_give_equal_bytes(path: Path, uninterrupted: bytes) -> None:
    assert record(path) == uninterrupted


def test_what_is_undone_has_no_place_in_a_trace(path: Path, uninterrupted: bytes) -> None:
    recording = Recording(path).begin().play(last=20)
    recording.recorder.event(WentBack(time=11.0, events=3, why="back"))
    assert recording.play(first=20).close() == uninterrupted


# -- broken off -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("end", range(1, len(EVENTS) + 1))
def test_killed_after_any_event_and_resumed_at_a_boundary_it_ends_as_if_never_killed(
    path: Path, uninterrupted: bytes, end: int
) -> None:
    killed = Recording(path).begin().play(last=end).kill().part.read_bytes()
    for boundary in (number for number in BOUNDARIES if number <= end):
        recording = Recording(path)
        recording.part.write_bytes(killed)
        assert recording.resume(boundary).play(first=boundary).close() == uninterrupted


@pytest.mark.parametrize("stop", [2, 5, 14, 20, 33])
def test_what_was_flushed_within_a_stage_survives_and_changes_no_byte_of_the_end(
    path: Path, uninterrupted: bytes, stop: int
) -> None:
    recording = Recording(path).begin().play(last=stop)
    recording.recorder.flush()
    recording.play(first=stop, last=stop + 1).kill()
    assert Recording(path).resume(stop).play(first=stop).close() == uninterrupted


def test_every_flush_leaves_all_events_on_the_disk_and_changes_no_byte_of_the_end(
    path: Path, uninterrupted: bytes
) -> None:
    recording = Recording(path).begin()
    for number in range(1, len(EVENTS) + 1):
        recording.play(first=number - 1, last=number).recorder.flush()
        assert _events_in(recording.part) == EVENTS[:number]
    assert recording.close() == uninterrupted


def test_a_run_that_was_stopped_and_closed_goes_on_as_if_never_stopped(
    path: Path, uninterrupted: bytes
) -> None:
    Recording(path).begin().play(last=17).close()
    assert Recording(path).resume(17).play(first=17).close() == uninterrupted


@pytest.mark.slow
def test_resuming_a_run_again_and_again_changes_no_byte(path: Path, uninterrupted: bytes) -> None:
    recording = Recording(path).begin()
    for number in range(1, len(EVENTS)):
        recording.play(first=number - 1, last=number).recorder.flush()
        recording = recording.kill().resume(number)
    assert recording.play(first=len(EVENTS) - 1).close() == uninterrupted


@pytest.mark.parametrize("cut", range(1, len(EVENTS)))
def test_going_back_to_any_event_and_forward_again_changes_no_byte(
    path: Path, uninterrupted: bytes, cut: int
) -> None:
    recording = Recording(path).begin().play(last=min(cut + 9, len(EVENTS)))
    recording.recorder.cut(cut)
    assert recording.play(first=cut).close() == uninterrupted


def test_going_back_takes_out_what_was_sensed_since(path: Path, uninterrupted: bytes) -> None:
    recording = Recording(path).begin().play(last=5)
    recording.recorder.tick(PERIOD)
    recording.recorder.cut(5)
    assert recording.play(first=5).close() == uninterrupted


def test_what_was_sensed_before_the_run_began_is_no_part_of_it(path: Path, uninterrupted: bytes) -> None:
    recording = Recording(path).begin()
    recording.recorder.tick(PERIOD)
    assert recording.play().close() == uninterrupted


def test_a_run_that_is_closed_between_two_events_keeps_what_was_sensed_since(path: Path) -> None:
    recording = Recording(path).begin().play(last=5)
    recording.recorder.flush()
    recording.recorder.tick(PERIOD)
    recording.close()
    assert len(read_trace(path).times) == 9


def test_going_back_to_before_the_start_of_the_run_begins_the_trace_anew(
    path: Path, uninterrupted: bytes
) -> None:
    recording = Recording(path).begin().play(last=9)
    recording.recorder.cut(0)
    assert recording.play().close() == uninterrupted


def test_events_that_the_trace_has_lost_are_written_again(path: Path) -> None:
    recording = Recording(path).begin().play(last=8).kill()
    recording.part.write_bytes(recording.part.read_bytes()[:2000])
    Recording(path).resume(BOUNDARIES[2]).play(first=BOUNDARIES[2]).close()
    trace = read_trace(path)
    assert list(trace.events) == EVENTS
    assert trace.counts["/joint_states"] == 24


def test_of_two_files_that_were_left_the_one_that_holds_more_is_gone_on_with(
    path: Path, uninterrupted: bytes
) -> None:
    Recording(path).begin().play(last=BOUNDARIES[2]).close()
    Recording(path).begin().play(last=BOUNDARIES[1]).kill()
    assert Recording(path).resume(BOUNDARIES[2]).play(first=BOUNDARIES[2]).close() == uninterrupted


def test_a_run_is_not_continued_in_the_trace_of_another_one(path: Path) -> None:
    other = Recording(path).begin()
    other.recorder.event(started(time=99.0))
    other.close()
    Recording(path).resume(5).play(first=5).close()
    assert list(read_trace(path).events) == EVENTS


def test_a_run_that_never_began_leaves_nothing(path: Path) -> None:
    Recording(path).begin().recorder.close()
    assert list(path.parent.iterdir()) == []


def test_closing_twice_does_no_harm(path: Path, uninterrupted: bytes) -> None:
    recording = Recording(path).begin().play()
    recording.close()
    assert recording.close() == uninterrupted


def _record_and_die(path: Path, last: int) -> None:
    Recording(path).begin().play(last=last)
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.slow
def test_a_program_that_is_killed_leaves_the_trace_up_to_its_last_flush(path: Path) -> None:
    child = multiprocessing.get_context("spawn").Process(
        target=_record_and_die, args=(path, BOUNDARIES[2] + 3)
    )
    child.start()
    child.join()
    recording = Recording(path)
    assert child.exitcode == -signal.SIGKILL
    assert list(read_trace(recording.part, lenient=True).events) == EVENTS[: BOUNDARIES[2]]


# -- no room ----------------------------------------------------------------------------------------------


class Disk:
    """A disk with so many bytes left."""

    def __init__(self, room: int, monkeypatch: pytest.MonkeyPatch, *, at_once: int = 1 << 30) -> None:
        self.room, self._at_once, self._write = room, at_once, os.write
        monkeypatch.setattr(mcap_writer.os, "write", self.write)

    def write(self, handle: int, data: bytes) -> int:
        if self.room == 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        done = self._write(handle, data[: min(self.room, self._at_once)])
        self.room -= done
        return done


def test_a_disk_that_takes_a_few_bytes_at_a_time_gets_them_all(
    path: Path, monkeypatch: pytest.MonkeyPatch, uninterrupted: bytes
) -> None:
    Disk(1 << 30, monkeypatch, at_once=100)
    assert record(path) == uninterrupted


def _events_in(file: Path) -> list[object]:
    return list(read_trace(file, lenient=True).events)


def test_a_full_disk_is_said_once_and_loses_nothing_that_was_flushed(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    flushed = BOUNDARIES[1]
    recording = Recording(path).begin().play(last=flushed)
    Disk(700, monkeypatch)
    with pytest.raises(InvalidInput, match=FULL):
        recording.play(first=flushed)
    recording.recorder.event(EVENTS[-1])
    recording.recorder.flush()
    recording.recorder.cut(3)
    recording.recorder.close()
    kept = _events_in(recording.part)
    assert kept == EVENTS[: len(kept)]
    assert len(kept) >= flushed
    assert not path.exists()


def test_a_trace_that_the_disk_had_no_room_for_is_finished_when_it_has(
    path: Path, monkeypatch: pytest.MonkeyPatch, uninterrupted: bytes
) -> None:
    recording = Recording(path).begin().play(last=BOUNDARIES[1])
    disk = Disk(700, monkeypatch)
    with pytest.raises(InvalidInput, match=FULL):
        recording.play(first=BOUNDARIES[1])
    recording.recorder.close()
    disk.room = 1 << 30
    assert Recording(path).resume(BOUNDARIES[1]).play(first=BOUNDARIES[1]).close() == uninterrupted


def test_going_back_on_a_full_disk_is_refused_and_the_trace_goes_on(
    path: Path, monkeypatch: pytest.MonkeyPatch, uninterrupted: bytes
) -> None:
    recording = Recording(path).begin().play(last=BOUNDARIES[2])
    disk = Disk(2000, monkeypatch)
    with pytest.raises(InvalidInput, match=FULL):
        recording.recorder.cut(12)
    disk.room = 1 << 30
    assert recording.play(first=BOUNDARIES[2]).close() == uninterrupted


def test_resuming_on_a_full_disk_is_refused_and_what_was_there_stays(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    part = Recording(path).begin().play(last=BOUNDARIES[2]).kill().part
    before = part.read_bytes()
    Disk(2000, monkeypatch)
    with pytest.raises(InvalidInput, match=FULL):
        Recording(path).resume(BOUNDARIES[1])
    assert [file.name for file in path.parent.iterdir() if file != path.with_name("whole.mcap")] == [
        part.name
    ]
    assert part.read_bytes() == before


def test_a_place_that_cannot_be_written_to_is_refused(path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"^.*cannot be written: No such file or directory$"):
        Recording(path.parent / "nowhere" / "short.mcap").begin()


@pytest.mark.parametrize("events", BOUNDARIES[1:-1])
def test_a_trace_begun_at_a_checkpoint_goes_on_as_that_of_the_whole_run(
    path: Path, uninterrupted: bytes, events: int
) -> None:
    late = Recording(path).resume(events)
    late.frames.now, late.frames.carrier_shown = between(events, events + 1)[0].poses, False
    late.play(events).close()
    whole = read_trace(path.with_name("whole.mcap"))
    assert whole.events == tuple(EVENTS)
    assert first_difference(whole, read_trace(path), unseen=events) is None
