"""The table in docs/sigma_checks.md and the tests say the same: which tests show each row, and which rows are open."""

import importlib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

import pytest

ROOT: Final = Path(__file__).parents[3]
PAGE: Final = ROOT / "docs/sigma_checks.md"
ROWS: Final = 54
MACHINES: Final = {
    "- Perfect motors: ": ("machine", "interleavings", "language", "runs", "table1"),
    "- The wires of the bus, with an ideal machine on which the test sets forces and beams: ": (
        "bus", "bus_commands", "diagnosis", "line", "over_wires",
    ),
    "- Two gantries with physics, in worlds without errors and in random worlds: ": (
        "chess", "gantries", "handover", "insert", "line", "prco",
    ),
    "- One motor whose rotor lags and may slip: ": ("motors",),
}  # fmt: skip
"""The machines on which tests run, as the page describes them, and the files of these tests."""
_ROW: Final = re.compile(r"^\| (?P<number>\d+) \| (?P<statement>.*?) \|.*\|.*\|$")


def _marked() -> Iterator[tuple[int, str]]:
    """Rows, and the tests that show them."""
    for file in sorted(Path(__file__).parent.glob("test_*.py")):
        for name, found in vars(importlib.import_module(file.stem)).items():
            for mark in getattr(found, "pytestmark", ()) if name.startswith("test_") else ():
                if mark.name == "sigma_row":
                    yield mark.args[0], f"`{file.relative_to(ROOT)}::{name}`"


def _listed(numbers: set[int]) -> str:
    """Numbers in words, such as `rows 1 to 3, 5 and 7`."""
    spans = [[number] for number in sorted(numbers) if number - 1 not in numbers]
    for span in spans:
        while span[-1] + 1 in numbers:
            span.append(span[-1] + 1)
    words = [
        word
        for span in spans
        for word in ([f"{span[0]} to {span[-1]}"] if len(span) > 2 else [*map(str, span)])
    ]
    return "rows " + (" and ".join((", ".join(words[:-1]), words[-1])) if len(words) > 1 else words[0])


def _head(line: str, shown: dict[int, list[str]]) -> str:
    """A line of the list of machines, with the rows that their tests show."""
    begin = next((each for each in MACHINES if line.startswith(each)), None)
    if begin is None:
        return line
    files = tuple(f"/test_sigma_{name}.py:" for name in MACHINES[begin])
    here = {row for row, tests in shown.items() if any(file in test for file in files for test in tests)}
    return f"{begin}{_listed(here)}."


def _written(line: str, shown: dict[int, list[str]]) -> str:
    row = _ROW.match(line)
    if row is None:
        return _head(line, shown)
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
