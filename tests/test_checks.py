"""The table in docs/checks.md and the tests say the same: what shows each row, and in how many worlds.

A test that shows a row bears the mark `row`, with the number of worlds in which it shows it: those without errors
(nominal) and drawn ones. A second test in worlds that the first has counted counts none.
"""

import importlib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Final

import pytest

ROOT: Final = Path(__file__).parent.parent
DOC: Final = (ROOT / "docs/checks.md").read_text(encoding="utf-8")
LINES: Final = [line.strip("| ").split(" | ") for line in DOC.splitlines() if re.match(r"\| \d+ \|", line)]
"""Of each row of the table: its number, what is given, its state, its worlds, its tests."""
ROWS: Final = range(1, 61)


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """A test that shows a row."""

    row: int
    test: str
    nominal: int
    drawn: int


def _mark(number: int, nominal: int = 0, drawn: int = 0) -> tuple[int, int, int]:
    """The arguments of the mark."""
    return number, nominal, drawn


def _marked(file: Path) -> Iterator[Shown]:
    """Tests of a file that show rows."""
    for name, found in vars(importlib.import_module(file.stem)).items():
        for mark in getattr(found, "pytestmark", ()) if name.startswith("test_") else ():
            if mark.name == "row":
                number, nominal, drawn = _mark(*mark.args, **mark.kwargs)
                test = f"{file.relative_to(ROOT)}::{name}"
                yield Shown(row=number, test=test, nominal=nominal, drawn=drawn)


@cache
def _shown() -> tuple[Shown, ...]:
    """Every test that shows a row."""
    files = [
        file
        for file in sorted((ROOT / "tests").rglob("test_*.py"))
        if "pytest.mark.row(" in file.read_text(encoding="utf-8") and file != Path(__file__)
    ]
    with pytest.MonkeyPatch.context() as patch:
        for file in files:  # tests import what lies beside them
            patch.syspath_prepend(file.parent)
        return tuple(shown for file in files for shown in _marked(file))


def _worlds(shown: list[Shown]) -> str:
    """The worlds in which tests show a row, as the table has them."""
    counts = {"nominal": sum(s.nominal for s in shown), "drawn": sum(s.drawn for s in shown)}
    return ", ".join(f"{count} {kind}" for kind, count in counts.items() if count) or "none"


def test_the_table_has_a_line_for_every_row_in_order() -> None:
    assert [int(line[0]) for line in LINES] == list(ROWS)


@pytest.mark.parametrize("row", ROWS)
def test_the_table_names_the_tests_that_are_marked_with_the_row(row: int) -> None:
    named = re.findall(r"`(tests/\S+::\w+)`", LINES[row - 1][4])
    assert named == [shown.test for shown in _shown() if shown.row == row] != []


@pytest.mark.parametrize("row", ROWS)
def test_the_table_counts_the_worlds_that_the_tests_count(row: int) -> None:
    assert LINES[row - 1][3] == _worlds([shown for shown in _shown() if shown.row == row])


def test_no_test_is_marked_with_a_row_that_there_is_not() -> None:
    assert {shown.row for shown in _shown()} == set(ROWS)


@pytest.mark.parametrize("row", ROWS)
def test_a_row_is_shown_fully_or_says_what_is_missing(row: int) -> None:
    assert re.fullmatch(r"fully|partly: \S.{10,}", LINES[row - 1][2])


def test_the_summary_counts_the_rows() -> None:
    fully = sum(line[2] == "fully" for line in LINES)
    worlds = [line[3] for line in LINES]
    drawn = sum("drawn" in found for found in worlds)
    nominal = sum("nominal" in found and "drawn" not in found for found in worlds)
    assert f"The tests cover {fully} rows fully and {len(LINES) - fully} rows partly." in DOC
    assert f"The tests of {drawn} rows run in drawn worlds" in DOC
    assert f"and the tests of {nominal} rows run only in the nominal world." in DOC
    assert f"The other {len(LINES) - drawn - nominal} rows need no world" in DOC
