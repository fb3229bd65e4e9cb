"""The exercise on concurrent tasks: right and wrong programs, judged in every order of their tasks."""

from pathlib import Path

import pytest

from handeye.core.source import Source, read_source
from handeye.exercises import exercises
from handeye.exercises.exercise import Grade, Submission

RIGHT = read_source(Path(__file__).parent / "solutions" / "share.mal").text
SHARE = exercises()["share"]


def graded(text: str) -> Grade:
    """The grade of a program."""
    source = Source(name="share.mal", text=text)
    return SHARE.grade(Submission(source=source, taught=None, seeds=(), jobs=1, told=lambda _: None))


def changed(old: str, new: str) -> str:
    """The right program with one line changed."""
    assert old in RIGHT
    return RIGHT.replace(old, new)


def test_the_solution_is_right_in_every_order() -> None:
    assert graded(RIGHT).exit_code == 0


def test_the_program_of_the_start_is_a_silent_failure_with_a_hint_and_a_command() -> None:
    found = graded(SHARE.program.text)
    (first,) = found.failures
    assert found.exit_code == 3
    assert first.outcome == "the hands of both arms may meet"
    assert first.again == "handeye sigma check share.mal --interleavings"
    assert "TAKE it before" in found.hints[0]


@pytest.mark.parametrize(
    ("old", "new", "code", "outcome"),
    [
        ("25 SET PLACEFREE\n", "", 1, "no task can continue"),
        ("385 SET PLACEFREE", "375 SET PLACEFREE", 3, "the hands of both arms may meet"),
        ("145 TAKE PLACEFREE\n", "", 3, "the hands of both arms may meet"),
        ("50 PRINT", "45 GOTO 40\n50 PRINT", 1, "the program never ends"),
    ],
)
def test_a_wrong_program_is_named(old: str, new: str, code: int, outcome: str) -> None:
    found = graded(changed(old, new))
    assert (found.exit_code, found.failures[0].outcome) == (code, outcome)


def test_the_work_of_the_tasks_must_stay() -> None:
    found = graded(changed("330 MOVE X2 TO 300\n", ""))
    assert found.exit_code == 1
    assert found.failures[0].reason.startswith("the task SCREWER does not have the same MOVE")
    assert graded(changed("50 PRINT", "45 MOVE X1 TO 0\n50 PRINT")).failures[0].outcome == "broke a rule"
