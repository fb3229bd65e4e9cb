"""The page on the listing of 1973 gives the right lines of the programs that follow the listing."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "listing_1973.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in row.strip("|").split("|")]
    for row in re.findall(r"^\|.*\|$", PAGE.partition("## In the three programs")[2], re.MULTILINE)[2:]
]
PLACE = re.compile(r"((?:\d+, )*\d+)(?!\d| to)(?<! to \d{2})(?<! to \d{3})(?:: `([^`]*)`)?")
"""Lines of a program, and how they begin if they are not as in the reconstruction."""


def tutorial() -> str:
    """The program of the tutorial's section 7."""
    text = (ROOT / "docs/language/tutorial.md").read_text(encoding="utf-8")
    return text.partition("## 7.")[2].partition("```al pin.al\n")[2].partition("```")[0]


def plan(name: str) -> str:
    return (ROOT / "plans" / f"{name}.al").read_text(encoding="utf-8")


def bare(line: str) -> str:
    """A line without its label and comment, with single spaces, and with `.1` for `0.1`."""
    text = re.sub(r"^\w+:", "", line.partition(";")[0])
    return re.sub(r"\b0(?=\.\d)", "", " ".join(text.split()))


@pytest.mark.parametrize(
    ("column", "script", "least"),
    [(2, tutorial(), 19), (3, plan("insertion_1973"), 16), (4, plan("water_pump_1973"), 40)],
    ids=["tutorial", "insertion_1973", "water_pump_1973"],
)
def test_each_line_says_what_the_page_says(column: int, script: str, least: int) -> None:
    lines = ["", *map(bare, script.splitlines())]
    told = [
        (int(number), bare(own or row[1].strip("`")))
        for row in ROWS
        for numbers, own in PLACE.findall(row[column])
        for number in numbers.split(", ")
    ]
    assert len(told) >= least
    assert [
        (number, text, lines[number]) for number, text in told if not lines[number].startswith(text)
    ] == []


def test_the_page_of_1973_sets_each_step_beside_a_stage_of_the_program() -> None:
    page = (ROOT / "docs" / "1973.md").read_text(encoding="utf-8")
    steps = re.findall(
        r"^\| (\d+) \| [^|]* \| `([^`]*)` \|", page.partition("### The eleven steps")[2], re.MULTILINE
    )
    stages = re.findall(r'^ *STAGE +"(.*)"', plan("water_pump_1973"), re.MULTILINE)
    assert [stage for _, stage in steps[:11]] == stages
    assert [int(number) for number, _ in steps[:11]] == list(range(1, 12))
