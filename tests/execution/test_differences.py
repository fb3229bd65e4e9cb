"""SAVE and RESTORE: which difference is kept, and how it shifts the next motion."""

import pytest
from fake_runs import FakeRun, fake_run

pytestmark = pytest.mark.slow

SERVO = 0.01
"""How far (in) the servo may end from its set-point."""
OFF = "MOVE T\nCHANGE [1 0 0] .3\nSAVE D\n"
"""The hand is .3 in beside T, and saves that."""


def carried_out(script: str) -> FakeRun:
    run = fake_run(script).go()
    assert (run.errors, run.called) == ([], False)
    return run


def test_a_restored_difference_is_added_to_the_goal() -> None:
    run = carried_out(f"{OFF}MOVE T\nRESTORE D")
    assert run.off() == pytest.approx([0.3, 0, 0], abs=SERVO)


def test_a_level_restore_leaves_the_height_as_it_was_taught() -> None:
    run = carried_out("MOVE T\nCHANGE [3 0 4] .5\nSAVE D\nMOVE T\nRESTORE D LEVEL")
    assert run.off() == pytest.approx([0.3, 0, 0], abs=SERVO)


def test_what_is_saved_again_keeps_what_was_restored() -> None:
    run = carried_out(f"{OFF}MOVE T\nRESTORE D\nCHANGE [0 1 0] .2\nSAVE D")
    assert run.saved("D") == pytest.approx([0.3, 0.2, 0], abs=SERVO)


def test_what_is_saved_under_another_name_is_only_what_came_since() -> None:
    run = carried_out(f"{OFF}MOVE T\nRESTORE D\nCHANGE [0 1 0] .2\nSAVE E")
    assert run.saved("E") == pytest.approx([0, 0.2, 0], abs=SERVO)


def test_an_action_behind_center_saves_the_whole_difference_again() -> None:
    run = fake_run("MOVE T\nCENTER .1\nCHANGE [1 1 0] .3\nSAVE D")
    run.cell.hand.thickness = lambda _: 0.02
    run.go()
    assert run.saved("D") == pytest.approx([0.212, 0.212, 0], abs=SERVO)


def test_the_place_of_a_search_belongs_to_the_difference() -> None:
    run = fake_run("SEARCH .2\nL: MOVE T\nSAVE D\nAOJ L")
    while run.steps.count("SAVE D") != 2:
        run.executor.step()
    assert run.saved("D") == pytest.approx([0.2, 0, 0], abs=SERVO)
