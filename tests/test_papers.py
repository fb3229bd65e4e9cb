"""The pages that compare the papers with handeye name everything that a paper prints, each with a way to repeat it."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from test_commands_page import refused

DOCS = Path(__file__).parent.parent / "docs"
OF_1973 = (DOCS / "1973.md").read_text(encoding="utf-8")
OF_OTHERS = (DOCS / "siblings.md").read_text(encoding="utf-8")
UNCOMPARED = re.compile(r"not (compared|comparable|given|measured|exist)|does not work")
"""How a row says that nothing can be repeated."""
TIMINGS = ("planning phase", "working phase", "manipulation", "lens change and focus", "visual processing")


def table(page: str, heading: str) -> list[str]:
    """The rows of the tables below a heading, without the names of the columns."""
    section = re.split(rf"^#+ {re.escape(heading)}$", page, flags=re.MULTILINE)[1]
    section = re.split(r"^#+ ", section, flags=re.MULTILINE)[0]
    return re.findall(r"^\|.*\|$", section, re.MULTILINE)[2:]


def first_cell(row: str) -> str:
    return row.split("|")[1].strip()


def numbers(text: str) -> Iterator[int]:
    """The numbers in a cell such as `figures 4 to 6`, or `figures 9, 12 and 14`."""
    if span := re.search(r"(\d+) to (\d+)", text):
        yield from range(int(span[1]), int(span[2]) + 1)
    else:
        yield from map(int, re.findall(r"\d+", text))


TABLES = [
    *(
        (OF_1973, heading)
        for heading in ("Every picture", "Every listing", "Every timing", "Every other figure")
    ),
    *(
        (OF_OTHERS, f"{kind} of {year}")
        for year in (1975, 1981, 1982)
        for kind in ("Figures and listings", "Values")
    ),
]


def test_every_picture_of_1973_has_one_row() -> None:
    assert [int(first_cell(row)) for row in table(OF_1973, "Every picture")] == list(range(1, 14))


def test_every_timing_of_1973_has_a_row() -> None:
    assert [first_cell(row) for row in table(OF_1973, "Every timing")][:5] == list(TIMINGS)


@pytest.mark.parametrize(("year", "figures"), [(1975, 5), (1981, 16), (1982, 22)])
def test_every_figure_of_a_later_paper_has_one_row(year: int, figures: int) -> None:
    cells = [first_cell(row) for row in table(OF_OTHERS, f"Figures and listings of {year}")]
    named = [number for cell in cells if cell.startswith("figure") for number in numbers(cell)]
    assert sorted(named) == list(range(1, figures + 1))


@pytest.mark.parametrize(("page", "heading"), TABLES, ids=[heading for _, heading in TABLES])
def test_every_row_has_a_command_or_a_place_or_says_that_nothing_can_be_compared(
    page: str, heading: str
) -> None:
    rows = table(page, heading)
    assert len(rows) > 1
    places = re.compile(r"`[^`]+`|\]\([^)]+\)|the command for picture \d|the same \||\brow \d")
    assert [row for row in rows if not (places.search(row) or UNCOMPARED.search(row))] == []


@pytest.mark.parametrize("page", [OF_1973, OF_OTHERS], ids=["1973", "siblings"])
def test_every_command_can_be_typed_as_it_stands(page: str) -> None:
    commands = [*dict.fromkeys(re.findall(r"`(handeye [^`]*)`", page))]
    assert len(commands) > 15
    assert {command: wrong for command in commands if (wrong := refused(command)) is not None} == {}


def test_each_picture_that_refers_to_another_refers_to_one_with_a_command() -> None:
    rows = {first_cell(row): row for row in table(OF_1973, "Every picture")}
    referred = {
        number for row in rows.values() for number in re.findall(r"the command for picture (\d+)", row)
    }
    assert referred
    assert [number for number in referred if "`handeye " not in rows[number]] == []
