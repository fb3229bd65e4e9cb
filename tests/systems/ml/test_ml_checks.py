"""The table in docs/ml_checks.md and the tests say the same: which tests show each row, and which rows are open."""

import importlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import pytest

ROOT: Final = Path(__file__).parents[3]
PAGE: Final = ROOT / "docs/ml_checks.md"
ROWS: Final = 58
_ROW: Final = re.compile(r"^\| (?P<number>\d+) \| (?P<statement>.*?) \|.*\|.*\|$")


def _marked() -> Iterator[tuple[int, str]]:
    """Rows, and the tests that show them."""
    for file in sorted(Path(__file__).parent.glob("test_*.py")):
        for name, found in vars(importlib.import_module(file.stem)).items():
            for mark in getattr(found, "pytestmark", ()) if name.startswith("test_") else ():
                if mark.name == "ml_row":
                    yield mark.args[0], f"`{file.relative_to(ROOT)}::{name}`"


def _written(line: str, shown: dict[int, list[str]]) -> str:
    row = _ROW.match(line)
    if row is None:
        return line
    tests = sorted(shown.get(int(row["number"]), []))
    state = "shown" if tests else "open"
    return f"| {row['number']} | {row['statement']} | {state} | {', '.join(tests)} |"


def test_the_table_has_every_row_and_names_the_tests_that_show_it(request: pytest.FixtureRequest) -> None:
    shown: dict[int, list[str]] = {}
    for number, test in _marked():
        shown.setdefault(number, []).append(test)
    text = PAGE.read_text(encoding="utf-8")
    written = "".join(f"{_written(line, shown)}\n" for line in text.splitlines())
    if request.config.getoption("--update"):
        PAGE.write_text(written, encoding="utf-8")
        text = written
    assert text == written
    numbers = [int(row["number"]) for line in text.splitlines() if (row := _ROW.match(line))]
    assert numbers == [*range(1, ROWS + 1)]
