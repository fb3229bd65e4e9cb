"""UNDO STAGE: the program has the arm undo its stage and begins it anew, as often as it says and no more."""

import pytest
from fake_runs import fake_run

from handeye.program.events import StageUndone, UndoEnded, UndoOrdered
from handeye.runs.snapshot import interfered

TWICE = 'STAGE "A"\nASSIGN N 1\nL: OPEN 2\nSOJG N,L\nUNDO STAGE TIMES 2\nSTAGE "B"\nOPEN 1'
"""Its counter is what it was each time that the stage begins; how often it was undone is not taken back."""


def test_a_stage_is_undone_as_often_as_it_says_and_then_the_program_goes_on() -> None:
    run = fake_run(TWICE).go()
    assert not run.called
    assert [event.stage for event in run.all(StageUndone)] == ["A", "A"]
    assert [event.left for event in run.all(UndoOrdered)] == [0, 0]
    assert len(run.all(UndoEnded)) == 2
    assert run.steps.count("OPEN 1") == 1
    assert run.executor.state.undoing is None
    assert run.executor.state.unwound == {}  # the stage has ended


def test_only_the_stage_under_way_is_undone() -> None:
    run = fake_run('STAGE "A"\nOPEN 1\nSTAGE "B"\nOPEN 2\nUNDO STAGE').go()
    assert [event.stage for event in run.all(StageUndone)] == ["B"]
    assert [event.left for event in run.all(UndoOrdered)] == [1]


def test_a_stage_that_begins_again_may_be_undone_again() -> None:
    around = 'ASSIGN N 2\nSTAGE "A"\nL: OPEN 2\nUNDO STAGE\nSTAGE "B"\nOPEN 1\nSOJG N,L'
    assert len(fake_run(around).go().all(UndoOrdered)) == 2


@pytest.mark.parametrize(("times", "seen"), [("", 1), ("TIMES 3", 3)])
def test_it_is_counted_for_each_statement(times: str, seen: int) -> None:
    run = fake_run(f'STAGE "A"\nOPEN 2\nUNDO STAGE {times}\nUNDO STAGE').go()
    assert len(run.all(UndoOrdered)) == seen + 1


def test_what_the_program_asks_for_is_no_interference() -> None:
    assert not interfered(fake_run(TWICE).go().events)
