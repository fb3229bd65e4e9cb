"""Processes are kept from trial to trial; one that is lost costs the trial it was at, which is tried once more."""

from pathlib import Path

import pytest
from trial_functions import hung, killed_always, killed_once, paused, process, refused

from handeye.core.errors import InvalidInput
from handeye.trials.workers import WorkerLost, answers, in_processes

pytestmark = pytest.mark.slow


def test_processes_are_kept_from_trial_to_trial() -> None:
    found = [answer.value for answer in answers(process, range(8), 2)]
    assert sorted(item for item, _ in found) == [*range(8)]
    assert len({number for _, number in found}) <= 2


def test_a_trial_whose_process_is_killed_is_tried_once_more_and_that_is_counted(tmp_path: Path) -> None:
    found = {answer.item.name: answer for answer in answers(killed_once, [tmp_path / "a", tmp_path / "b"], 1)}
    assert {name: (each.value, each.killed) for name, each in found.items()} == {
        "a": ("tried again", 1), "b": ("tried again", 1),
    }  # fmt: skip


def test_a_trial_whose_process_is_killed_twice_costs_no_other(tmp_path: Path) -> None:
    bad, well = tmp_path / "bad", tmp_path / "well"
    found = {each.item: each for each in answers(killed_always, [bad, well], 2)}
    assert (found[bad].lost, found[bad].value, found[bad].killed) == (True, None, 2)
    assert (found[well].lost, found[well].value, found[well].killed) == (False, "done", 0)


def test_a_trial_that_hangs_is_ended_and_not_tried_again() -> None:
    found = {each.item: each for each in answers(hung, ["hung", "well"], 1, limit_s=0.1)}
    assert (found["hung"].overdue, found["hung"].lost, found["well"].value) == (True, False, "done")


def test_a_process_that_is_stopped_for_longer_than_its_limit_goes_on() -> None:
    (found,) = answers(paused, ["went on"], 1, limit_s=0.4)
    assert (found.value, found.killed, found.overdue) == ("went on", 0, False)
    assert found.wall_s > 0.5


@pytest.mark.parametrize("limit", [1e9, 1e300])
def test_a_limit_may_be_longer_than_the_system_can_keep(limit: float) -> None:
    assert [each.value for each in answers(refused, [2], 1, limit_s=limit)] == [2]


def test_an_exception_is_an_answer() -> None:
    found = {each.item: each for each in answers(refused, [1, 2], 1)}
    assert (str(found[1].error), found[2].value) == ("1 is odd", 2)


def test_who_wants_values_alone_is_told_what_a_trial_raises_or_that_its_process_was_lost(
    tmp_path: Path,
) -> None:
    with pytest.raises(InvalidInput, match=r"^1 is odd$"):
        list(in_processes(refused, [2, 1], 1))
    with pytest.raises(WorkerLost, match=r"^the process of a trial was killed 2 times, "):
        list(in_processes(killed_always, [tmp_path / "bad"], 1))
