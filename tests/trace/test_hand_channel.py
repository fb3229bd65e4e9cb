"""The channel of the hand tells what is felt and which guard watches, and makes up nothing where nothing is felt."""

from pathlib import Path
from typing import Any

import msgspec
import pytest
from recordings import HISTORY, record

from handeye.ports.workcell import Sensed
from handeye.trace.channels import CHANNELS, HAND
from handeye.trace.reading import read_trace

PERIODS = [moment for moment in HISTORY if isinstance(moment.what, Sensed)]


@pytest.fixture
def told(tmp_path: Path) -> list[dict[str, Any]]:
    """The messages of a recording, as any reader of JSON sees them."""
    record(tmp_path / "short.mcap")
    messages = read_trace(tmp_path / "short.mcap").messages
    return [msgspec.json.decode(message.data) for message in messages if message.topic == HAND]


def test_every_servo_period_has_its_message(told: list[dict[str, Any]]) -> None:
    assert [message["estimated"] for message in told] == [period.guarded for period in PERIODS]


def test_force_and_moment_are_those_of_the_hand_on_the_world(told: list[dict[str, Any]]) -> None:
    for message, period in zip(told, PERIODS, strict=True):
        if period.guarded:
            felt = [message[name][axis] for name in ("force", "moment") for axis in "xyz"]
            assert felt == pytest.approx((-period.effort).tolist(), abs=1e-6)


def test_where_nothing_is_estimated_there_is_no_force_and_no_guard(told: list[dict[str, Any]]) -> None:
    silent = [set(message) for message in told if not message["estimated"]]
    assert silent
    assert not any(names & {"force", "moment", "guards"} for names in silent)


def test_the_guard_is_told_with_its_limit_and_axis(told: list[dict[str, Any]]) -> None:
    guards = [message["guards"] for message in told if message["estimated"]]
    there = {"guard": "force", "limit": 8.0, "axis": {"x": 0.0, "y": 0.0, "z": -1.0}}
    assert all(found == [there] for found in guards)


def test_its_schema_stands_in_one_piece_and_knows_every_field(told: list[dict[str, Any]]) -> None:
    (schema,) = [channel.schema for channel in CHANNELS if channel.topic == HAND]
    assert b"$ref" not in schema
    assert b"anyOf" not in schema
    content = msgspec.json.decode(schema)
    assert content["type"] == "object"
    assert set().union(*told) == set(content["properties"])
    assert set.intersection(*map(set, told)) >= set(content["required"])
