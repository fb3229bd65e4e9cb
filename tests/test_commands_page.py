"""Each command in the tables of docs/commands.md can be typed as it stands: with what is in brackets, and without."""

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest
from cyclopts import CycloptsError

from handeye.cli import app

PAGE = (Path(__file__).parent.parent / "docs" / "commands.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (`[^-].*?`[^|]*) \|", PAGE, re.MULTILINE)
FOR = {
    "N": "3",
    "M": "8",
    "DIR": "pump",
    "RUN": "pump",
    "TOPIC": "faults",
    "FOLDER": "folder",
    "STAGE": "pins",
    "NAME": "insertion",
    "FAULT": "base.absent",
}
"""Words that stand for others; a name with an ending is taken as it is."""


def typed() -> Iterator[str]:
    """The commands of the table, each as long and as short as it can be."""
    for row in ROWS:
        for quoted in re.findall(r"`(handeye [^`]*)`", row):
            yield from dict.fromkeys((re.sub(r" ?\[[^\]]*\]", "", quoted), re.sub(r"[\[\]]", "", quoted)))


def refused(command: str) -> str | None:
    """What the command line finds wrong with a command, which is not carried out."""
    words = [FOR.get(word, word) for word in shlex.split(command)[1:]]
    try:
        app.parse_args(words, exit_on_error=False, print_error=False)
    except CycloptsError as error:
        return str(error)
    return None


@pytest.mark.parametrize("command", list(typed()))
def test_a_row_can_be_typed_as_it_stands(command: str) -> None:
    assert refused(command) is None


def test_the_tables_hold_nothing_but_commands() -> None:
    quoted = [words for row in ROWS for words in re.findall(r"`([^`]*)`", row)]
    assert len(quoted) > 50
    assert [words for words in quoted if not words.startswith("handeye ")] == []


def test_what_cannot_be_typed_is_seen() -> None:
    assert refused("handeye trace export tables -o x")
    assert refused("handeye trace thin DIR")
