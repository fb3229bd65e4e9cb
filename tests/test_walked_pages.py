"""Whoever types what the tutorial and the walk through the stepper say, in an empty folder, sees what they show.

After a deliberate change `pytest tests/test_walked_pages.py --update` writes what is printed now; read the difference.
"""

import shlex
from pathlib import Path

import pytest
from conftest import Command
from walked_pages import BLOCK, Typed, walked, with_outputs

from handeye import al
from handeye.debugger.formatting import MAX_STEPS_SHOWN, as_text
from handeye.debugger.stepper import Stepper
from handeye.runs.checkpoint_file import read_checkpoint
from handeye.runs.runner import Runner

DOCS = Path(__file__).parent.parent / "docs"
TUTORIAL, WALK, START = DOCS / "language" / "tutorial.md", DOCS / "stepping.md", DOCS / "start.md"
BEGUN = "pin/checkpoints/0006-insert-it.checkpoint"
"""The checkpoint at which the session of the walk begins."""
FOLLOWED = ("stages insertion_1973", "run insertion_1973", "trace show pin", "trace verify pin")
"""Commands of the walk that a reader can type; others stand for many."""


def kept(page: Path, typed: list[Typed], request: pytest.FixtureRequest, *, shown: int) -> None:
    """Everything that the page shows was printed; with --update it is made to."""
    if request.config.getoption("--update"):
        page.write_text(with_outputs(page.read_text(encoding="utf-8"), typed), encoding="utf-8")
        return
    assert [each.line for each in typed if each.code not in (0, 1)] == []
    assert [(each.line, each.printed) for each in typed if each.shown and not each.stands] == []
    assert len([each for each in typed if each.shown]) >= shown


@pytest.mark.slow
def test_the_tutorial_can_be_followed(command: Command, request: pytest.FixtureRequest) -> None:
    def run(line: str) -> tuple[int, str]:
        code, out, err = command(*shlex.split(line))
        return (0, err + out) if line.startswith("check ") else (code, out)

    kept(TUTORIAL, walked(TUTORIAL.read_text(encoding="utf-8"), run), request, shown=15)


@pytest.mark.slow
def test_the_first_five_minutes_can_be_followed(command: Command, request: pytest.FixtureRequest) -> None:
    def run(line: str) -> tuple[int, str]:
        return (0, "") if line.startswith("report ") else command(*shlex.split(line))[:2]

    typed = walked(START.read_text(encoding="utf-8"), run)
    kept(START, [each for each in typed if each.printed], request, shown=4)


@pytest.mark.slow
def test_the_walk_through_the_stepper_can_be_followed(
    command: Command, request: pytest.FixtureRequest
) -> None:
    session: list[Stepper] = []

    def run(line: str) -> tuple[int, str]:
        if not line.startswith(FOLLOWED):
            return 0, ""
        if line.endswith("--step"):
            session.append(Stepper(Runner(read_checkpoint(Path(BEGUN)))))
            return 0, as_text(session[0].standing()) + "\n"
        code, out, _ = command(*shlex.split(line))
        return code, out

    def said(line: str) -> tuple[int, str]:
        return 0, as_text(session[0].do(line), MAX_STEPS_SHOWN) + "\n"

    typed = walked(WALK.read_text(encoding="utf-8"), run, said)
    kept(WALK, [each for each in typed if each.printed], request, shown=15)


def test_the_programs_of_the_tutorial_are_laid_out_as_the_formatter_does() -> None:
    blocks = BLOCK.findall(TUTORIAL.read_text(encoding="utf-8"))
    programs = [content for language, _, content in blocks if language == "al"]
    assert len(programs) > 10
    assert [text for text in programs if al.format_text(text) != text] == []
