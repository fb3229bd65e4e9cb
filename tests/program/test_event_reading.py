"""A system adds kinds of events to those of all; a reader learns from the start of a run which they are."""

import math
from pathlib import Path

import msgspec
import pytest

from handeye.core import entries
from handeye.core.errors import InvalidInput
from handeye.core.pose import Array
from handeye.core.units import MILLIMETRES, Measures
from handeye.core.variation import WorldSpec
from handeye.ports.camera import Renderer
from handeye.program.event_reading import EventReader, own_kinds, read_packed
from handeye.program.events import AnyEvent, RunFinished, RunStarted, SystemEvent, to_line
from handeye.trace.account import account
from handeye.trace.eventlist import read_events
from handeye.trace.sentences import level_of, sentence


class LimitCrossed(SystemEvent, frozen=True, kw_only=True):
    """A sensor has crossed a limit."""

    limit: float
    importance = "warning"

    def sentence(self, measures: Measures) -> str:
        return f"the limit of {measures.distance(self.limit)} is crossed"


CROSSED = LimitCrossed(time=1.0, limit=0.02)
EVENTS: list[AnyEvent] = [
    RunStarted(
        time=0.0, system="machine", program="p", steps=1, plan="", arm="", arm_digest="", world=WorldSpec(seed=0),
        camera=Renderer(method="none"), versions={},
    ),
    CROSSED,
    RunFinished(time=2.0, completed=True),
]  # fmt: skip


KINDS = (LimitCrossed,)


class Saved(SystemEvent, frozen=True, kw_only=True):
    """A kind of a name that all systems have."""


class Sighting(SystemEvent, frozen=True, kw_only=True):
    """A kind with a field that JSON does not have."""

    picture: Array


WRONG, NONE, ARRAYS = (Saved,), (3,), (Sighting,)
TWICE = (LimitCrossed, type("LimitCrossed", (LimitCrossed,), {}))


def entry(kinds: str) -> entries.Entry:
    """The entry of a machine that adds some kinds of events."""
    return entries.Entry(
        name="machine", title="the machine", help="", system="", events=f"{__name__}:{kinds}"
    )


@pytest.fixture
def machine(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(entries, "_registered", {})
    entries.register(entry("KINDS"))


@pytest.fixture
def written(tmp_path: Path) -> Path:
    path = tmp_path / "events.jsonl"
    path.write_bytes(b"".join(map(to_line, EVENTS)))
    return path


@pytest.mark.usefixtures("machine")
def test_a_list_with_events_of_a_system_is_read_by_the_start_of_its_run(written: Path) -> None:
    assert read_events(written) == EVENTS


@pytest.mark.usefixtures("machine")
def test_events_of_a_system_are_packed_into_a_checkpoint() -> None:
    packed = msgspec.Raw(msgspec.msgpack.encode(EVENTS))
    assert read_packed(packed, "machine") == tuple(EVENTS)
    with pytest.raises(ValueError, match=r"^events of the kind `LimitCrossed` are unknown here: the system"):
        read_packed(packed, "other")


def test_a_system_tells_its_events_in_the_measures_of_its_task() -> None:
    assert sentence(CROSSED, MILLIMETRES) == "the limit of 20.0 mm is crossed"
    assert level_of(CROSSED) == level_of(msgspec.structs.replace(CROSSED)) is not None


def test_a_kind_that_is_not_known_is_told_with_the_system_it_takes(written: Path) -> None:
    with pytest.raises(InvalidInput) as refused:
        read_events(written)
    assert str(refused.value) == (
        f"line 2 of {written} is not an event: events of the kind `LimitCrossed` are unknown here: the system "
        "`machine` is not installed"
    )


@pytest.mark.usefixtures("machine")
def test_a_kind_of_another_version_is_told_as_such() -> None:
    with pytest.raises(
        msgspec.DecodeError,
        match="known here: the events come from another version of handeye, or from another version of the system ",
    ):
        EventReader("machine").read(b'{"event":"Sneezed","time":1.0}')


def test_an_event_that_could_not_be_read_back_is_not_written() -> None:
    with pytest.raises(
        InvalidInput, match=r"^an event LimitCrossed cannot be written: Expected `float`, got `null`"
    ):
        to_line(LimitCrossed(time=1.0, limit=math.nan))


def test_no_system_can_give_another_meaning_to_a_common_kind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(entries, "_registered", {"machine": entry("WRONG")})
    with pytest.raises(InvalidInput, match=r"WRONG defines a kind of event with the reserved name Saved$"):
        own_kinds("machine")


@pytest.mark.parametrize(
    ("kinds", "error"),
    [
        ("MISSING", "AttributeError"), ("NONE", "AttributeError"), ("ARRAYS", "TypeError"), ("TWICE", "TypeError"),
    ],
)  # fmt: skip
def test_kinds_that_cannot_be_loaded_written_or_read_are_told_in_a_sentence(
    written: Path, monkeypatch: pytest.MonkeyPatch, kinds: str, error: str
) -> None:
    monkeypatch.setattr(entries, "_registered", {"machine": entry(kinds)})
    with pytest.raises(InvalidInput, match=rf"{kinds}`? cannot be (loaded|imported): {error}: "):
        read_events(written)


def test_the_account_of_a_run_tells_them_in_words() -> None:
    assert "the limit of 0.79 in is crossed" in "\n".join(account(EVENTS))
