"""Senses are checked once as a stage begins; a check that does not hold stops the run before its first operation."""

import pytest
from fake_runs import fake_run

from handeye.core.errors import GAP_WRONG
from handeye.execution import sense_checks
from handeye.execution.context import ExecutionContext
from handeye.execution.state import Fault, ReversalOrder
from handeye.program.diagnosis.causes import GapStill

SCRIPT = 'STAGE "A"\nOPEN 1\nOPEN 2\nSTAGE "B"\nOPEN 3\nOPEN 2\n'
WRONG = Fault(number=GAP_WRONG, cause=GapStill(gap=0.0, driven=0.01))


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Fault | None]:
    """What a check answers, last first; nothing is wrong from then on."""
    answers: list[Fault | None] = []
    monkeypatch.setattr(sense_checks, "CHECKS", (lambda _: answers.pop() if answers else None,))
    return answers


def test_the_senses_are_checked_once_a_stage(monkeypatch: pytest.MonkeyPatch) -> None:
    found = []

    def check(run: ExecutionContext) -> None:
        found.append((run.state.stage, run.state.at))

    monkeypatch.setattr(sense_checks, "CHECKS", (check,))
    fake_run(SCRIPT).go()
    assert found == [(0, 0), (1, 2)]


def test_the_first_check_that_fails_stops_the_stage(asked: list[Fault | None]) -> None:
    asked += [WRONG, None]
    run = fake_run(SCRIPT).go()
    assert run.errors == [GAP_WRONG]
    assert run.steps == ["OPEN 1", "OPEN 2", "OPEN 3"]
    assert run.executor.state.onward == 2  # nothing of it was carried out
    assert "the gap still reads" in run.told


@pytest.mark.parametrize(("choice", "errors"), [("proceed", 1), ("retry", 2)])
def test_whoever_retries_has_the_senses_checked_again(
    asked: list[Fault | None], choice: str, errors: int
) -> None:
    asked += [WRONG, WRONG, None]
    run = fake_run(SCRIPT).go()
    run.executor.answer(choice)  # type: ignore[arg-type]
    run.go()
    assert run.errors == [GAP_WRONG] * errors
    assert run.called == (choice == "retry")


def test_a_stage_that_was_undone_begins_with_a_check_again(asked: list[Fault | None]) -> None:
    run = fake_run(SCRIPT).go()
    run.executor.undo(ReversalOrder(left=2))
    asked.append(WRONG)
    run.go()
    assert run.errors == [GAP_WRONG]
