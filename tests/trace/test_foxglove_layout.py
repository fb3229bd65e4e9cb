"""The layout in docs/ shows what there is in a trace: every channel, and every value on it."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from recordings import record

from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace

LAYOUT = json.loads((Path(__file__).parents[2] / "docs" / "foxglove-layout.json").read_text(encoding="utf-8"))
PANELS = LAYOUT["configById"]
PATH = re.compile(r'(/[a-z_/]+)(?:\{(\w+)=="(\w+)"\})?((?:\.\w+|\[\d+\])*)')
"""A channel, a value that its messages must have, and the way to a value in them."""


def texts(value: Any) -> list[str]:
    """All texts in a piece of the layout, names too."""
    if isinstance(value, dict):
        return [text for item in value.items() for each in item for text in texts(each)]
    if isinstance(value, list):
        return [text for each in value for text in texts(each)]
    return [value] if isinstance(value, str) else []


PATHS = sorted({text for text in texts(PANELS) if text.startswith("/")})


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    path = tmp_path_factory.mktemp("layout") / "a.mcap"
    record(path)
    return read_trace(path)


def values(trace: Trace, path: str) -> list[object]:
    """What a path of the layout leads to in the messages of a trace."""
    found = PATH.fullmatch(path)
    assert found is not None
    topic, field, wanted, way = found.groups()
    told = [json.loads(message.data) for message in trace.messages if message.topic == topic]
    for step in re.findall(r"\w+", way):
        told = [
            message[int(step) if step.isdecimal() else step]
            for message in told
            if (field is None or message.get(field) == wanted) and _has(message, step)
        ]
        field = None
    return told


def _has(message: Any, step: str) -> bool:
    return int(step) < len(message) if step.isdecimal() else step in message


def test_every_kind_of_panel_is_there() -> None:
    assert {name.split("!")[0] for name in PANELS} == {"3D", "Image", "Plot", "RosOut", "StateTransitions"}
    placed = {text for text in texts(LAYOUT["layout"]) if "!" in text}
    assert placed == {*PANELS}


@pytest.mark.parametrize("path", PATHS)
def test_every_channel_is_in_a_trace(trace: Trace, path: str) -> None:
    found = PATH.match(path)
    assert found is not None
    assert trace.counts[found[1]] > 0


@pytest.mark.parametrize("path", [path for path in PATHS if "." in path])
def test_every_value_is_in_some_message(trace: Trace, path: str) -> None:
    assert values(trace, path)
