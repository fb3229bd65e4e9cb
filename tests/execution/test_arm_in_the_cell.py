"""The arm in the cell: set free it stays where it is, and without its computer it stops."""

import numpy as np
import pytest
from driving import Drive, tick
from pump_bench import Bench, bench, written

from handeye.arm.dynamics import gravity
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.simulated import SimulatedCell
from handeye.errors import WATCHDOG
from handeye.ports.workcell import Sensed
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.units import DEGREE

pytestmark = pytest.mark.slow

POUND = 4.448
"""Weight of a pound, N."""


def released(cell: SimulatedCell, seconds: float, weight: float = 0.0) -> Sensed:
    """Brakes off, no set-point: the drives carry the arm's own weight wherever it is."""
    for _ in range(round(seconds * 60)):
        tick(cell.devices, Drive(torque=gravity(STANFORD, cell.devices.arm.read().q)))
    return cell.devices.sense()


def push(cell: SimulatedCell, axis: int, force: float) -> None:
    """The experimenter pushes at the hand along an axis of W (N)."""
    cell.truth.data.xfrc_applied[cell.truth.model.body("stanford/link6").id, axis] = force


@pytest.fixture
def cell() -> SimulatedCell:
    return build_cell(PumpWorld.nominal(), camera="ray")


def test_row_31_the_released_arm_drifts_less_than_half_a_degree_in_ten_seconds(cell: SimulatedCell) -> None:
    before = cell.devices.sense().q
    assert np.abs(released(cell, 10.0).q - before)[[0, 1, 3, 4, 5]].max() < 0.5 * DEGREE


def test_row_31_a_push_of_three_pounds_moves_the_released_arm(cell: SimulatedCell) -> None:
    before = cell.devices.sense().q
    push(cell, 1, 3 * POUND)
    assert np.abs(released(cell, 1.0).q - before).max() > 2 * DEGREE


def late_in(script: str, ticks: int) -> Bench:
    """A run in which the computer misses one servo period, `ticks` after the hand was at T."""
    run = bench("OPEN 2\nMOVE T\nSEARCH 1\n" + script, positions={"T": written(25, 38, 6, 0)}).to("SEARCH")
    count = iter(range(10_000))

    def watch(_: object) -> None:
        if next(count) == ticks:
            run.cell.advance(run.run.drive.period)

    run.run.drive.watch = watch
    return run.go()


ACTIONS = ["CHANGE [0 0 -1] 2", "STOP 9\nCHANGE [0 0 1] 2", "MOVE PARK", "CENTER", "OPEN 3"]


@pytest.mark.parametrize("script", ACTIONS)
def test_row_34_a_missed_servo_period_aborts_the_action(script: str) -> None:
    run = late_in(script, 20)
    assert run.errors == [WATCHDOG]
    assert run.told == "the computer missed a servo period: drives cut, brakes set"


def test_row_34_the_arm_stands_still_at_once_with_its_brakes_set() -> None:
    run = late_in("CHANGE [0 0 -1] 2", 30)
    start = run.hand()
    run.rest(1.0)
    assert run.run.drive.sensed.braked
    assert run.hand() == pytest.approx(start, abs=0.01)
    assert 4.5 < run.hand()[2] < 5.9
