"""The table in docs/trig_checks.md and the tests say the same: what shows each statement, and what is open."""

import importlib
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Final

import pytest

ROOT: Final = Path(__file__).parents[3]
DOC: Final = (ROOT / "docs/trig_checks.md").read_text(encoding="utf-8")
LINES: Final = [line.strip("| ").split(" | ") for line in DOC.splitlines() if re.match(r"\| \d+ \|", line)]
"""Of each row: its number, what is given, what happens, its state, its tests."""
ROWS: Final = range(1, 41)
NEED_PHYSICS: Final = {5, 12, 13, 14, 25, 26, 27, 28, 30, 31, 37, 38}
FEWER: Final = {25, 26, 27, 28}
"""Shown with fewer blocks than the statement has: twenty take minutes."""


def _marked(file: Path) -> Iterator[tuple[int, str]]:
    """Rows, and tests of a file that show them."""
    for name, found in vars(importlib.import_module(file.stem)).items():
        for mark in getattr(found, "pytestmark", ()) if name.startswith("test_") else ():
            if mark.name == "trig_row":
                yield mark.args[0], f"{file.relative_to(ROOT)}::{name}"


@cache
def _shown() -> tuple[tuple[int, str], ...]:
    """Every row that is shown, and by which test."""
    files = [file for file in sorted(Path(__file__).parent.glob("test_trig_*.py")) if file != Path(__file__)]
    return tuple(shown for file in files for shown in _marked(file))


def test_the_table_has_a_line_for_every_row_in_order() -> None:
    assert [int(line[0]) for line in LINES] == list(ROWS)


@pytest.mark.parametrize("row", ROWS)
def test_a_row_is_shown_by_the_tests_that_bear_its_number(row: int) -> None:
    state, tests = LINES[row - 1][3:]
    named = re.findall(r"`(tests/\S+::\w+)`", tests)
    shown = sorted(test for number, test in _shown() if number == row)
    assert (state, named) == ("with fewer blocks" if row in FEWER else "fully", shown)
    assert shown


def test_tests_that_are_named_exist() -> None:
    for file, name in re.findall(r"`(tests/\S+)::(\w+)`", DOC):
        assert f"def {name}(" in (ROOT / file).read_text(encoding="utf-8")


def test_the_summary_counts_the_rows() -> None:
    states = [line[3] for line in LINES]
    assert (states.count("fully"), len(NEED_PHYSICS), len(FEWER)) == (36, 12, 4)
    assert "28 need no physics, and tests on the ideal arm demonstrate them fully" in DOC
    assert "The other 12 concern touch, speed and carried blocks" in DOC
    assert "Eight of the 12 are demonstrated fully" in DOC
    assert "The other four concern the palletiser with all its blocks" in DOC


@pytest.mark.parametrize("row", sorted(NEED_PHYSICS))
def test_a_row_that_needs_physics_is_shown_with_it(row: int) -> None:
    files = {test.split("::")[0] for number, test in _shown() if number == row}
    assert files == {f"tests/systems/trig/test_trig_{'jobs' if row in FEWER else 'physics'}.py"}
