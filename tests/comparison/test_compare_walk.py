"""The walk in docs/compare.md: two scripts in one world, and what the page says of their runs."""

import re
from pathlib import Path

import pytest
from conftest import Command

DOC = (Path(__file__).parents[2] / "docs" / "compare.md").read_text(encoding="utf-8")
SCRIPT = re.findall(r"```al\n(.*?)```", DOC, re.DOTALL)[0]
WALK = re.findall(r"```\n(\$ .*?)```", DOC, re.DOTALL)[0]

pytestmark = pytest.mark.slow


def test_the_page_says_what_the_commands_say(command: Command) -> None:
    Path("pin.al").write_text(SCRIPT, encoding="utf-8")
    Path("blind.al").write_text(re.sub(r".*CENTER.*\n", "", SCRIPT), encoding="utf-8")
    for line in WALK.split("$ handeye ")[1:]:
        words, _, said = line.partition("\n")
        code, out, _ = command(*words.split())
        assert code == 0
        if said:
            assert out == said
