"""The pages about TRIG show what happens; `pytest FILE --update -n 0` writes it into them."""

import re
from pathlib import Path

import pytest
from trig_pages import Page

from handeye.systems.trig.language.command_table import TABLE

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "docs" / name for name in ("trig.md", "trig_commands.md")]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_shows_is_what_happens(
    page: Path, request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = page.read_text(encoding="utf-8")
    happened = Page().carried_out(text)
    if request.config.getoption("--update"):
        page.write_text(happened, encoding="utf-8")
    assert happened == text


def test_every_command_has_a_line_in_its_page() -> None:
    text = PAGES[1].read_text(encoding="utf-8")
    assert re.findall(r"^\| `(.+?)` \|", text.replace("\\|", "|"), re.MULTILINE) == [
        row.usage for row in TABLE
    ]


def test_the_tutorial_teaches_every_kind_of_command() -> None:
    typed = set(re.findall(r"^>([A-Z]+)", PAGES[0].read_text(encoding="utf-8"), re.MULTILINE))
    assert {
        "FREE",
        "HERE",
        "GOPOS",
        "M",
        "MR",
        "MG",
        "GRASP",
        "LOOP",
        "SAVPOS",
        "L",
        "RUN",
        "GOTO",
        "P",
        "W",
    } - typed == set()
