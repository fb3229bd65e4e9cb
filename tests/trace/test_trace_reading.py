"""What is not a whole, sound trace of ours is refused with one sentence."""

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.writer import Writer
from recordings import BOUNDARIES, EVENTS, PLAN, Recording, record

from handeye.core.errors import InvalidInput
from handeye.trace.channels import FORMAT, METADATA
from handeye.trace.reading import read_trace
from handeye.trace.records import DamagedTrace, check


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A sound trace."""
    path = tmp_path_factory.mktemp("sound") / "short.mcap"
    record(path)
    return path


def _refusal(path: Path, data: bytes) -> str:
    """What is said of a file that is refused."""
    path.write_bytes(data)
    with pytest.raises(InvalidInput) as refused:
        read_trace(path)
    return str(refused.value)


def _mcap(metadata: dict[str, str], name: str = METADATA, plan: bytes = PLAN) -> bytes:
    """A sound MCAP file with these metadata, a plan and no message."""
    file = io.BytesIO()
    writer = Writer(file, enable_data_crcs=True)
    writer.start()
    writer.add_metadata(name, metadata)
    writer.add_attachment(0, 0, "plan.json", "application/json", plan)
    writer.finish()
    return file.getvalue()


@pytest.mark.slow
def test_every_flipped_bit_is_noticed(path: Path) -> None:
    data = bytearray(path.read_bytes())
    check(bytes(data))
    for place in range(len(data)):
        data[place] ^= 1 << place % 8
        with pytest.raises(DamagedTrace, match=r"^is (cut short|damaged)$"):
            check(bytes(data))
        data[place] ^= 1 << place % 8


@pytest.mark.slow
@given(data=st.data())
def test_a_file_with_a_flipped_bit_is_refused_in_one_sentence(path: Path, data: st.DataObject) -> None:
    whole = path.read_bytes()
    bit = data.draw(st.integers(0, 8 * len(whole) - 1))
    flipped = bytearray(whole)
    flipped[bit // 8] ^= 1 << bit % 8
    other = path.with_name("flipped.mcap")
    assert _refusal(other, bytes(flipped)).startswith(str(other))


@pytest.mark.slow
@given(data=st.data())
def test_a_file_that_is_cut_short_is_refused(path: Path, data: st.DataObject) -> None:
    whole = path.read_bytes()
    length = data.draw(st.integers(0, len(whole) - 1))
    other = path.with_name("short.cut.mcap")
    assert _refusal(other, whole[:length]).startswith(str(other))


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "is not a trace: it is not an MCAP file"),
        (b'{"event":"RunStarted"}', "is not a trace: it is not an MCAP file"),
        (_mcap({}, "something else"), "is not a trace of handeye: its metadata do not say “handeye trace”"),
        (_mcap({"format": FORMAT}), "does not state its version of the trace format"),
        (
            _mcap({"format": FORMAT, "version": "soon"}),
            "does not state its version of the trace format",
        ),
        (
            _mcap({"format": FORMAT, "version": "3"}),
            "has trace format version 3; this version of handeye reads version 4",
        ),
        (_mcap({"format": FORMAT, "version": "4"}), "does not begin with the start of a run"),
    ],
)
def test_what_is_not_a_trace_of_ours_is_refused(tmp_path: Path, data: bytes, said: str) -> None:
    other = tmp_path / "other.mcap"
    assert _refusal(other, data) == f"{other} {said}"


def test_a_trace_of_which_the_end_is_missing_is_said_to_be_cut_short(path: Path) -> None:
    other = path.with_name("end.mcap")
    assert _refusal(other, path.read_bytes()[:-1]) == f"{other} is cut short"


def test_a_trace_with_another_plan_is_refused(tmp_path: Path) -> None:
    recording = Recording(tmp_path / "short.mcap").begin()
    recording.recorder._writing._plan = PLAN.replace(b'"again"', b'"never"')
    recording.play().close()
    with pytest.raises(InvalidInput, match=r"^the plan in .*short\.mcap is not the plan of this run$"):
        read_trace(recording.path)


def test_a_trace_with_a_plan_that_is_none_is_refused(tmp_path: Path) -> None:
    recording = Recording(tmp_path / "short.mcap").begin()
    recording.recorder._writing._plan = b"no plan"
    recording.play().close()
    with pytest.raises(InvalidInput, match=r"^the plan in .*short\.mcap is not the plan of this run$"):
        read_trace(recording.path)


@pytest.mark.parametrize(
    "event",
    [
        b'{"event":"Sneezed","time":11.0}',
        b"[" * 100_000,
        b'{"event":"ErrorRaised","detail":' + b"[" * 100_000,
    ],
)
def test_an_event_that_is_not_known_is_refused(path: Path, event: bytes) -> None:
    other = path.with_name("newer.mcap")
    recording = Recording(other).begin().play(last=4)
    recording.recorder._writing.file.write("/events", 11, event)
    recording.close()
    assert _refusal(other, other.read_bytes()).startswith(f"{other}: event 5 cannot be read: ")


def test_a_message_that_is_not_what_its_channel_says_is_refused(path: Path) -> None:
    other = path.with_name("forged.mcap")
    recording = Recording(other).begin().play(last=4)
    recording.recorder._writing.file.write("/joint_states", 11, b"\xff")
    recording.close()
    with pytest.raises(
        InvalidInput, match=r"forged\.mcap: the message on /joint_states at 0\.000 s cannot be"
    ):
        read_trace(other).motion  # noqa: B018


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"^.*nothing\.mcap: there is no such file$"):
        read_trace(tmp_path / "nothing.mcap")


def test_what_a_broken_off_run_left_can_be_read_up_to_its_last_flush(tmp_path: Path) -> None:
    part = Recording(tmp_path / "short.mcap").begin().play(last=BOUNDARIES[2] + 3).kill().part
    assert list(read_trace(part, lenient=True).events) == EVENTS[: BOUNDARIES[2]]
    with pytest.raises(InvalidInput, match=r"^.*short\.mcap\.part is cut short$"):
        read_trace(part)


def test_reading_leniently_ends_before_a_damaged_chunk(path: Path) -> None:
    data = bytearray(path.read_bytes())
    data[data.rfind(b"\x28\xb5\x2f\xfd") + 50] ^= 16  # within the last chunk
    other = path.with_name("damaged.mcap")
    other.write_bytes(data)
    events: list[Any] = list(read_trace(other, lenient=True).events)
    assert events == EVENTS[: BOUNDARIES[-1]]
