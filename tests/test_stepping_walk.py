"""The walk in docs/stepping.md shows the script as it is, and commands that there are."""

import re
from pathlib import Path

import pytest

from handeye.resources import plans
from handeye.stepping.commands import find

DOC = (Path(__file__).parent.parent / "docs" / "stepping.md").read_text(encoding="utf-8")
SCRIPT = (plans() / "water_pump.al").read_text(encoding="utf-8").splitlines()

SAID = re.findall(r"^handeye> (.+)$", DOC, re.MULTILINE)
SHOWN = re.findall(r"^  [ →] (\d+)  ([L ].*\S)$", DOC, re.MULTILINE)


def test_the_walk_has_commands_and_excerpts_to_look_at() -> None:
    assert len(SAID) >= 10
    assert len(SHOWN) >= 25


@pytest.mark.parametrize("command", sorted(set(SAID)))
def test_a_command_of_the_walk_is_one_of_the_stepper(command: str) -> None:
    assert find(command)[0].name == command.split()[0]


@pytest.mark.parametrize(("line", "text"), sorted(set(SHOWN)))
def test_a_line_of_the_walk_stands_in_the_script(line: str, text: str) -> None:
    assert SCRIPT[int(line) - 1].strip() == text.strip()
