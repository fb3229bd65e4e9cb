"""Faults of the jobs of ML: each is named as its catalogue says, in one world."""

import json
from collections.abc import Callable

import pytest

from handeye.core.errors import Refused
from handeye.core.variation import WorldSpec
from handeye.systems.ml.run.fault_trials import fault_trials
from handeye.systems.ml.run.jobs import PROGRAMS
from handeye.tasks import any_task
from handeye.trials.faults import FaultTrial
from handeye.trials.sweep import Case

Command = Callable[..., tuple[int, str, str]]
WORLD = WorldSpec(seed=7)
QUICK = (
    "support frame.missing",
    "follow wand.open", "follow wand.closed", "follow plate.missing", "blocks motor.separation.dead",
    "train motor.separation.dead", "orient cradle.moved.x", "bin range.frozen", "bin gauge.left.z.dead",
)  # fmt: skip


def tried(job: str, fault: str) -> FaultTrial:
    (row,) = fault_trials(job, WORLD)[1](Case(trials=(0,), seed=7, condition=fault))
    assert row.tried is not None
    return row.tried


def test_each_fault_has_at_most_three_names() -> None:
    for job in PROGRAMS:
        for kind in any_task(job).faults(WORLD).kinds.values():
            assert len(kind.expected.calls) <= 3, (job, kind.name)


@pytest.mark.slow
@pytest.mark.parametrize("fault", QUICK)
def test_a_fault_of_a_sensor_a_drive_or_a_part_is_named(fault: str) -> None:
    found = tried(*fault.split())
    assert (found.outcome, found.exit_code) == ("stopped", 1), found.message


@pytest.mark.slow
def test_a_block_on_a_stack_that_is_not_empty_stops_at_a_wrong_height() -> None:
    assert tried("blocks", "stack.occupied").message.startswith("the block stops at a wrong height")


@pytest.mark.slow
def test_a_fault_is_tried_and_given_by_commands(command: Command) -> None:
    code, out, _ = command(
        *["faults", "--task", "follow", "--seed", "7", "--only", "motor.y.dead", "--jobs", "1", "--json"]
    )
    (found,) = json.loads(out)["faults"]
    assert (code, found["outcome"], found["message"]) == (0, "stopped", "motor 3 (y) does not reach its goal")
    code, out, _ = command(*["ml", "follow", "--seed", "7", "--fault", "wand.open", "--no-keep", "--json"])
    assert (code, json.loads(out)["completed"]) == (1, False)


def test_a_task_without_a_referee_has_no_trials_of_faults() -> None:
    with pytest.raises(Refused):
        fault_trials("rectilinear", WORLD)
