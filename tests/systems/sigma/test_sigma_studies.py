"""The JSON of all studies has the fields of an assembly."""

import json
from collections.abc import Callable

import pytest
from mal_bench import PLANS

Command = Callable[..., tuple[int, str, str]]


@pytest.mark.parametrize(
    ("words", "code", "stopped_at"),
    [
        ("axis --load 150", 1, None),
        ("bus demo", 0, None),
        (f"bus run {PLANS}/dead.mal", 1, "dead.mal"),
        ("bus errors --commands 20 --clock 2", 0, None),
        ("bus test --fault dead:Z1", 1, None),
        ("diagnose --fault dead", 0, None),
    ],
)
def test_a_study_has_the_fields_of_an_assembly(
    words: str, code: int, stopped_at: str | None, command: Command
) -> None:
    got, out, _ = command("sigma", *words.split(), "--json")
    found = json.loads(out)
    assert (got, found["completed"], found["stopped_at"]) == (code, code == 0, stopped_at)
    assert (found["assembled"], found["referee"]) == (None, {})
    assert words.startswith(found["task"])
    assert found["message"]
    assert found["figures"]
