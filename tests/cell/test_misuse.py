"""A cell that is used as it should not be refuses it in words, or does what the ports say."""

import math
from collections.abc import Callable

import msgspec
import numpy as np
import pytest
from block_task import BLOCK
from fakes import FakeArm, FakeClock
from robots import CARTESIAN

from handeye.arm.dynamics import gravity
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.simulated import SimulatedCell
from handeye.core.errors import InvalidInput, PhysicsFailed
from handeye.core.pose import Array
from handeye.core.variation import WorldSpec
from handeye.ports.clock import Clock
from handeye.ports.workcell import ArmPort
from handeye.tasks.stanford_cell.dimensions import PARK

PERIOD = CARTESIAN.servo.period


@pytest.fixture
def cell() -> SimulatedCell:
    return BLOCK.cell(WorldSpec(seed=0), camera="ray")


def borne(cell: SimulatedCell) -> Array:
    """Torques that bear the arm's weight where it stands."""
    return gravity(CARTESIAN, cell.devices.arm.read().q)


@pytest.mark.parametrize("seconds", [0.0, -PERIOD, math.nan, math.inf, PERIOD * 1.01])
def test_a_period_that_is_refused_changes_nothing(cell: SimulatedCell, seconds: float) -> None:
    cell.devices.arm.drive(borne(cell))
    before = msgspec.json.encode(cell.capture(), enc_hook=np.ndarray.tolist)
    with pytest.raises(InvalidInput, match=r"^(the clock cannot advance by|a period of) "):
        cell.advance(seconds)
    assert msgspec.json.encode(cell.capture(), enc_hook=np.ndarray.tolist) == before


@pytest.mark.parametrize("shape", [(), (1,), (2,), (4,), (1, 3)])
def test_torques_for_another_number_of_joints_are_refused(
    cell: SimulatedCell, shape: tuple[int, ...]
) -> None:
    with pytest.raises(InvalidInput, match=r"^torques of shape \(.*\) were sent to an arm of 3 joints$"):
        cell.devices.arm.drive(np.zeros(shape))


@pytest.mark.parametrize("torque", [np.zeros(2), np.full(3, np.nan)])
def test_a_torque_that_is_refused_does_not_answer_the_watchdog(cell: SimulatedCell, torque: Array) -> None:
    cell.devices.arm.drive(borne(cell))
    cell.advance(PERIOD)
    with pytest.raises(InvalidInput, match=r"torque"):
        cell.devices.arm.drive(torque)
    cell.advance(PERIOD)
    assert cell.devices.arm.read().braked


def test_a_torque_is_held_as_it_was_put_out_whatever_becomes_of_the_array(cell: SimulatedCell) -> None:
    torque = borne(cell)
    put_out = torque.copy()
    cell.devices.arm.drive(torque)
    torque += 50.0
    cell.advance(PERIOD)
    np.testing.assert_array_equal(cell.truth.data.ctrl[:3], put_out)


def test_nothing_is_read_anew_before_time_has_passed(cell: SimulatedCell) -> None:
    first = cell.devices.sense()
    cell.devices.arm.drive(np.zeros(3))
    cell.truth.data.qpos[:3] += 0.1
    again = cell.devices.sense()
    assert (again.q is first.q, again.gap, again.braked) == (True, first.gap, True)


def test_nobody_can_change_what_was_read(cell: SimulatedCell) -> None:
    read = cell.devices.arm.read()
    for values in (read.q, read.qd):
        with pytest.raises(ValueError, match=r"read-only"):
            values[0] = 9.0


Made = Callable[[], tuple[Clock, ArmPort, Array]]


def simulated() -> tuple[Clock, ArmPort, Array]:
    cell = BLOCK.cell(WorldSpec(seed=0), camera="ray")
    return cell, cell.devices.arm, borne(cell)


def fake() -> tuple[Clock, ArmPort, Array]:
    arm = FakeArm(PARK)
    return FakeClock(arm), arm, gravity(STANFORD, PARK)


@pytest.mark.parametrize("made", [simulated, fake])
@pytest.mark.parametrize(
    ("pieces", "cut"), [((1,), False), ((0.5, 0.5), False), ((2,), True), ((1, 0.0625), True), ((0.5, 0.5625), True)]
)  # fmt: skip
def test_an_arm_is_cut_once_a_period_has_passed_in_whatever_pieces(
    made: Made, pieces: tuple[float, ...], *, cut: bool
) -> None:
    clock, arm, torque = made()
    arm.drive(torque)
    for piece in pieces:
        clock.advance(piece * PERIOD)
    assert arm.read().braked is cut


@pytest.mark.parametrize("made", [simulated, fake])
def test_an_arm_that_was_cut_stays_cut_until_the_program_sets_its_brakes(made: Made) -> None:
    clock, arm, torque = made()
    arm.drive(torque)
    clock.advance(2 * PERIOD)
    seen = []
    for put in (torque, torque, None, torque):
        arm.drive(put)
        clock.advance(PERIOD)
        seen.append(arm.read().braked)
    assert seen == [True, True, True, False]


@pytest.mark.parametrize("pieces", [1, 60])
def test_a_hand_is_not_cut_with_its_arm_and_ends_where_it_is_told(cell: SimulatedCell, pieces: int) -> None:
    cell.devices.arm.drive(borne(cell))
    cell.advance(2 * PERIOD)
    assert cell.devices.hand is not None
    cell.devices.hand.drive(0.03, 20.0)
    for _ in range(pieces):
        cell.advance(60 // pieces * PERIOD)
    assert cell.devices.arm.read().braked
    assert cell.devices.hand.read().gap == pytest.approx(0.03, abs=1e-3)


@pytest.mark.parametrize("put", [(math.nan, 20.0), (0.03, math.inf)])
def test_a_hand_is_told_numbers_only(cell: SimulatedCell, put: tuple[float, float]) -> None:
    assert cell.devices.hand is not None
    with pytest.raises(
        InvalidInput, match=r"^the gap or the grip holds a value that is not a finite number$"
    ):
        cell.devices.hand.drive(*put)


def test_physics_that_broke_down_stay_so_until_the_cell_is_put_back(cell: SimulatedCell) -> None:
    sound = cell.capture()
    cell.truth.data.qvel[:3] = 1e12
    for _ in range(2):
        with pytest.raises(PhysicsFailed, match=r"^the simulated cell broke down \(mjWARN_\w+\)$"):
            cell.advance(PERIOD)
    cell.restore(sound)
    cell.advance(PERIOD)
    assert cell.now == pytest.approx(PERIOD)


def test_a_state_whose_watchdog_would_wait_too_long_is_refused(cell: SimulatedCell) -> None:
    state = cell.capture()
    state.mechanisms[cell.arm.name]["unanswered"] = -60.0
    with pytest.raises(
        InvalidInput, match=r"^this is not a state of this work cell: the saved time since the last command "
    ):
        cell.restore(state)


def test_two_devices_of_one_name_are_refused(cell: SimulatedCell) -> None:
    model, data = cell.truth.model, cell.truth.data
    with pytest.raises(ValueError, match=r"^devices and mechanisms of a cell need different names"):
        SimulatedCell(model, data, arm=cell.arm, mechanisms=(cell.arm,), noise=np.random.default_rng(0))
