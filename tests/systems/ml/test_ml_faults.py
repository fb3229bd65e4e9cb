"""Faults of the jobs of ML: each is named as its catalogue says, in one world."""

import json
from collections.abc import Callable

import numpy as np
import pytest
from msgspec.structs import replace

from handeye.core.errors import BadFile, Refused
from handeye.core.faults import Fault
from handeye.core.variation import WorldSpec
from handeye.ports.axes import AxesReading
from handeye.systems.ml.bench.arm import AXES
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.run.fault_trials import fault_trials
from handeye.systems.ml.run.jobs import PROGRAMS
from handeye.tasks import any_task
from handeye.trials.faults import FaultTrial
from handeye.trials.sweep import Case

Command = Callable[..., tuple[int, str, str]]
WORLD = WorldSpec(seed=7)
Y = [axis.name for axis in AXES].index("y")
QUICK = (
    "support frame.missing",
    "follow wand.open", "follow wand.closed", "follow plate.missing", "blocks motor.separation.dead",
    "train motor.separation.dead", "orient cradle.moved.x", "bin range.frozen", "bin gauge.left.z.dead",
    "bin bin.empty",
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


class Readings:
    """The arm of a station whose y slide goes to and fro, with a fault that begins after a time."""

    def __init__(self, fault: str, after: float | None = 0.05) -> None:
        world = ArmWorld(replace(WORLD, faults=(Fault(name=fault, after=after),)))
        self.station = Station(scene(world), world)
        self.station.arm.power(on=True)

    def read(self, cycles: int) -> list[AxesReading]:
        """Readings of so many cycles of 10 ms, in which the slide moves on by .5 mm in each."""
        found = []
        for _ in range(cycles):
            found.append(reading := self.station.arm.read())
            self.station.arm.put(reading.q + 0.0005 * (np.arange(len(reading.q)) == Y))
            self.station.bench.advance(0.01)
        return found


def test_a_fault_can_begin_after_a_time() -> None:
    y = [reading.q[Y] for reading in Readings("potentiometer.y.stuck").read(12)]
    assert np.all(np.diff(y[1:5]) > 0)
    assert {*y[5:]} == {y[5]}  # the reading of 50 ms
    arm = Readings("motor.y.dead")
    assert [*np.diff([reading.q[Y] for reading in arm.read(12)])[-4:]] == pytest.approx([0] * 4, abs=5e-5)
    wand = [reading.channels["wand"] for reading in Readings("wand.closed").read(8)]
    assert wand == [0] * 5 + [1] * 3
    assert [reading.channels["wand"] for reading in Readings("wand.closed", None).read(2)] == [1, 1]


def test_a_fault_that_has_begun_goes_on_after_a_restore() -> None:
    arm, other = Readings("potentiometer.y.stuck"), Readings("potentiometer.y.stuck")
    stuck = arm.read(8)[-1].q[Y]
    other.station.cell().restore(arm.station.cell().capture())
    assert {reading.q[Y] for reading in other.read(3)} == {stuck}
    with pytest.raises(BadFile, match="the faults of the saved arm are not those of this arm"):
        Readings("motor.y.dead").station.cell().restore(arm.station.cell().capture())


def test_a_weak_motor_is_weak_from_the_start() -> None:
    kinds = any_task("orient").faults(WORLD).kinds
    assert (kinds["motor.separation.weak"].when, kinds["motor.y.dead"].when) == ("before", "later")


def test_a_task_without_a_referee_has_no_trials_of_faults() -> None:
    with pytest.raises(Refused):
        fault_trials("rectilinear", WORLD)
