"""docs/exercises.md shows the exercises as handeye gives them."""

import re
import shlex
from pathlib import Path

import pytest
from conftest import Command
from walked_pages import walked, with_outputs

from handeye.exercises import exercises

PAGE = Path(__file__).parents[2] / "docs" / "exercises.md"


def section(name: str) -> str:
    """The section of the page on an exercise."""
    found = re.search(
        rf"^## {name}\n(.*?)(?=^## |\Z)", PAGE.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
    )
    assert found is not None
    return found[1]


@pytest.mark.parametrize("name", list(exercises()))
def test_the_page_has_the_task_the_rules_the_worlds_and_the_program_of_an_exercise(name: str) -> None:
    shown, exercise = section(name), exercises()[name]
    wanted = (
        exercise.brief,
        *(f"- {rule}\n" for rule in exercise.rules),
        f"Your program is judged in {exercise.cases}.\n",
        f"{exercise.program.text.rstrip()}\n```\n",
    )
    assert [text for text in wanted if text not in shown] == []


@pytest.mark.slow
def test_a_grade_on_the_page_is_a_real_one(command: Command, request: pytest.FixtureRequest) -> None:
    page = PAGE.read_text(encoding="utf-8")
    typed = walked(page, lambda line: command(*shlex.split(line))[:2])
    if request.config.getoption("--update"):
        PAGE.write_text(with_outputs(page, typed), encoding="utf-8")
        return
    assert [each.code for each in typed] == [0, 3, 3]
    assert [each.line for each in typed if not each.stands] == []
