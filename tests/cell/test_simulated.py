"""The simulated cell behind its ports."""

import math
import re

import mujoco
import numpy as np
import pytest

from handeye.arm.dynamics import gravity
from handeye.arm.ik import solve
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.simulated import SimulatedCell, SimulationError
from handeye.errors import InvalidInput
from handeye.ports.workcell import Drive, Sensed
from handeye.pose import Array, hand
from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.units import DEGREE, INCH, JIFFY

NONE = np.zeros(6)


def drive(
    torque: Array = NONE, *, brakes: bool = False, gap: float = 0.05, grip: float = 20.0, lamp: bool = False
) -> Drive:
    return Drive(torque=torque, brakes=brakes, gap=gap, grip=grip, tool=0.0, lamp=lamp)


@pytest.fixture
def cell() -> SimulatedCell:
    return SimulatedCell(PumpWorld.nominal(), camera="ray")


def run(cell: SimulatedCell, put: Drive, ticks: int) -> Sensed:
    for _ in range(ticks):
        cell.tick(put)
    return cell.sense()


def place_arm(cell: SimulatedCell, x: float, y: float, z: float, yaw: float) -> None:
    """Put the hand at a place (in) with its finger line at `yaw` (rad), pointing down."""
    X = hand(x * INCH, y * INCH, z * INCH, yaw, math.pi / 2, 0.0)
    data = cell.truth.data
    q = solve(STANFORD, X, data.qpos[:6]).q
    assert q is not None
    data.qpos[:6] = q
    mujoco.mj_forward(cell.truth.model, data)


def history(seed: int) -> bytes:
    cell = SimulatedCell(PumpWorld.sample(seed), camera="ray")
    parts = []
    for i in range(20):
        cell.tick(drive(np.full(6, 0.1 * i)))
        sensed = cell.sense()
        parts.append(np.hstack([sensed.q, sensed.qd, sensed.gap, sensed.tool_torque]).tobytes())
    return b"".join(parts)


def test_one_seed_gives_the_same_bytes_twice() -> None:
    assert history(5) == history(5)


def test_two_seeds_give_different_readings() -> None:
    assert history(5) != history(6)


def test_a_tick_is_a_sixtieth_of_a_second(cell: SimulatedCell) -> None:
    assert run(cell, drive(brakes=True), 60).time == pytest.approx(1.0, abs=1e-9)


def test_reading_twice_in_a_tick_gives_the_same() -> None:
    cell = SimulatedCell(PumpWorld.sample(1), camera="ray")
    assert cell.sense() is cell.sense()


def test_brakes_hold_the_arm_for_ten_seconds(cell: SimulatedCell) -> None:
    before = cell.sense().q
    assert np.abs(run(cell, drive(brakes=True), 600).q - before).max() < 0.01 * DEGREE


def test_without_brakes_or_torque_the_arm_falls(cell: SimulatedCell) -> None:
    before = cell.sense().q
    assert np.abs(run(cell, drive(), 30).q - before).max() > 5 * DEGREE


def test_the_released_arm_stays_where_it_is_yet_yields_to_a_hand(cell: SimulatedCell) -> None:
    torque, before = gravity(STANFORD, cell.sense().q), cell.sense().q
    still = run(cell, drive(torque), 60).q
    cell.truth.data.xfrc_applied[cell.truth.model.body("stanford/link6").id, 1] = 13.0  # N, three pounds
    pushed = run(cell, drive(torque), 60).q
    assert np.abs(still - before).max() < 0.1 * DEGREE
    assert np.abs(pushed - still).max() > 2 * DEGREE


def test_a_missed_period_cuts_drives_and_sets_brakes(cell: SimulatedCell) -> None:
    before = cell.sense().q
    cell.late()
    assert cell.sense().braked
    assert np.abs(run(cell, drive(np.full(6, 5.0)), 30).q - before).max() < 0.1 * DEGREE


def test_brakes_put_out_by_the_program_acknowledge_a_missed_period(cell: SimulatedCell) -> None:
    cell.late()
    cell.tick(drive(brakes=True))
    cell.tick(drive())
    assert not cell.sense().braked


def test_fingers_open_at_eight_centimetres_a_second(cell: SimulatedCell) -> None:
    start = run(cell, drive(brakes=True, gap=0.02), 60).gap
    first = run(cell, drive(brakes=True, gap=0.10), 15).gap
    last = run(cell, drive(brakes=True, gap=0.10), 30).gap
    assert start == pytest.approx(0.02, abs=1e-3)
    assert (last - first) / (30 * JIFFY) == pytest.approx(0.08, rel=0.02)


def test_both_switches_fire_on_the_driver_and_the_gap_is_its_width(cell: SimulatedCell) -> None:
    place_arm(cell, 6.0, 33.0, 7.0, math.pi / 2)
    before = run(cell, drive(brakes=True, gap=0.05), 20)
    after = run(cell, drive(brakes=True, gap=0.0, grip=40.0), 40)
    assert (before.touch, after.touch) == ((False, False), (True, True))
    assert after.gap == pytest.approx(0.0254, abs=2e-4)


def test_a_grip_presses_with_the_force_that_was_asked_for(cell: SimulatedCell) -> None:
    place_arm(cell, 6.0, 33.0, 7.0, math.pi / 2)
    run(cell, drive(brakes=True, gap=0.0, grip=40.0), 60)
    forces = [cell.truth.data.sensor(f"stanford/switch_{side}").data[0] for side in "ab"]
    assert forces == pytest.approx([40.0, 40.0], abs=2.0)


def test_the_lamp_burns_only_while_it_is_on(cell: SimulatedCell) -> None:
    lamp = cell.truth.model.geom("stanford/lamp").matid[0]
    seen = []
    for on in (True, False):
        cell.tick(drive(brakes=True, lamp=on))
        seen.append(float(cell.truth.model.mat_emission[lamp]))
    assert seen == [1.0, 0.0]


def test_a_drive_that_is_not_a_number_is_refused(cell: SimulatedCell) -> None:
    with pytest.raises(InvalidInput, match=r"^the drive holds a value that is not a finite number$"):
        cell.tick(drive(np.array([0, 0, np.nan, 0, 0, 0])))


def test_a_breakdown_of_the_physics_is_said_and_not_hidden(cell: SimulatedCell) -> None:
    cell.truth.data.qvel[:6] = 1e12
    with pytest.raises(
        SimulationError, match=re.compile(r"^the simulated cell broke down at .* s \(mjWARN_\w+\)$")
    ):
        run(cell, drive(), 2)


def test_a_resting_cell_has_only_the_arm_awake(cell: SimulatedCell) -> None:
    run(cell, drive(brakes=True), 60)
    assert cell.truth.data.ntree_awake == 1
