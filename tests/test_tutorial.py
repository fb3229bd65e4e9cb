"""Whoever types what the tutorial says, in an empty folder, sees what it shows.

After a deliberate change `pytest tests/test_tutorial.py --update` writes what is printed now; read the difference.
"""

from pathlib import Path

import pytest
from conftest import Command
from walked_pages import BLOCK, walked, with_outputs, words_of

from handeye import al

PAGE = Path(__file__).parent.parent / "docs" / "language" / "tutorial.md"


@pytest.mark.slow
def test_the_tutorial_can_be_followed(command: Command, request: pytest.FixtureRequest) -> None:
    def run(line: str) -> tuple[int, str]:
        code, out, err = command(*words_of(line))
        return code, err + out if line.startswith("check") else out

    page = PAGE.read_text(encoding="utf-8")
    typed = walked(page, run)
    if request.config.getoption("--update"):
        PAGE.write_text(with_outputs(page, typed), encoding="utf-8")
        return
    assert [each.words for each in typed if each.code not in (0, 1) and "check" not in each.words] == []
    assert [(each.words, each.printed) for each in typed if each.shown and not each.stands] == []
    assert len([each for each in typed if each.shown]) > 15


def test_the_programs_of_the_tutorial_are_laid_out_as_the_formatter_does() -> None:
    programs = [
        content
        for language, _, content in BLOCK.findall(PAGE.read_text(encoding="utf-8"))
        if language == "al"
    ]
    assert len(programs) > 10
    assert [text for text in programs if al.format_text(text) != text] == []
