"""The exercises on the insertion bench: right and wrong programs, each in a world that shows the difference."""

from pathlib import Path

import pytest

from handeye.core.source import Source, read_source
from handeye.exercises import exercises
from handeye.exercises.exercise import Exercise, Grade, Submission

SOLUTIONS = Path(__file__).parent / "solutions"


def graded(exercise: str | Exercise, source: Source, *seeds: int, taught: Source | None = None) -> Grade:
    """The grade of a program in the worlds of some seeds."""
    given = Submission(source=source, taught=taught, seeds=seeds, jobs=1, told=lambda _: None)
    return (exercises()[exercise] if isinstance(exercise, str) else exercise).grade(given)


def solution(name: str) -> Source:
    """A program of the folder `solutions`."""
    return read_source(SOLUTIONS / f"{name}.al")


@pytest.mark.slow
def test_a_hand_that_feels_the_plate_stops_on_it_and_one_that_trusts_the_plan_stops_above() -> None:
    assert graded("touch", solution("touch"), 2).exit_code == 0
    found = graded("touch", exercises()["touch"].program, 2)
    assert found.exit_code == 3
    assert "distance of the pin's end from the face of the plate" in found.failures[0].reason


@pytest.mark.slow
def test_a_pin_that_goes_in_with_a_blow_is_not_accepted() -> None:
    found = graded("gently", exercises()["gently"].program, 1)
    assert (found.exit_code, found.failures[0].outcome) == (1, "pressed too hard")
    assert "give a speed to each change" in found.hints[0].lower()


@pytest.mark.slow
def test_success_reported_where_no_hole_is_in_reach_is_silent_and_a_call_of_the_operator_is_right() -> None:
    quick = Source(name="honest.al", text=exercises()["honest"].program.text.replace("TRIES 24", "TRIES 1"))
    found = graded("honest", quick, 10)
    assert found.exit_code == 3
    assert found.failures[0].again.startswith(
        "handeye run honest.al --task insertion --seed 10 --set plate.x=20mm"
    )
    assert graded("honest", solution("honest_gives_up_at_once"), 10).exit_code == 0


@pytest.mark.slow
def test_a_teacher_can_grade_in_worlds_that_no_student_has_seen() -> None:
    other = exercises()["honest"].beginning_at(700)
    assert other.seeds == tuple(range(700, 720))
    (hopeless,) = graded(other, solution("honest_gives_up_at_once"), 710).verdicts
    assert (hopeless.case, hopeless.standing) == ("seed 710", "right")
    assert "--task insertion --seed 710 --set plate.x=20mm" in hopeless.again


def test_a_program_may_use_only_the_positions_of_the_exercise() -> None:
    touch = exercises()["touch"]
    assert touch.positions is not None
    moved = Source(name="mine.toml", text=touch.positions.text.replace("38.0", "38.1"))
    found = graded("touch", touch.program, 0, taught=moved)
    assert [each.reason for each in found.failures] == [
        "mine.toml does not have the taught positions of the exercise"
    ]
    own = Source(name="mine.al", text="        TRANS   NEAR [25 38 3.7 -90 90 0]\n" + touch.program.text)
    assert [each.reason for each in graded("touch", own, 0).failures] == [
        "the program defines the position NEAR"
    ]
    changes = Source(name="mine.al", text=touch.program.text + "        HERE    HOLE\n")
    assert [each.reason for each in graded("touch", changes, 0).failures] == [
        "the program changes the taught position HOLE"
    ]


def test_every_exercise_starts_from_a_program_without_errors() -> None:
    for each in exercises().values():
        given = Submission(source=each.program, taught=each.positions, seeds=(), jobs=1, told=lambda _: None)
        assert [found.code for found in each.diagnostics(given)] == []
        assert each.broken_rules(given) == []
        assert len(each.seeds) in (0, 20)
