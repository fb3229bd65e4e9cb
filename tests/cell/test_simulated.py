"""The simulated cell behind its ports."""

import math
import re
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from driving import BRAKED, Drive, tick

from handeye.arm.dynamics import gravity
from handeye.arm.ik import solve
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.simulated import SimulatedCell
from handeye.core.errors import InvalidInput, PhysicsFailed
from handeye.core.pose import hand
from handeye.core.units import DEGREE, INCH, JIFFY
from handeye.ports.workcell import Sensed
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.pump_world import PumpWorld

LOOSE = Drive(torque=np.zeros(6))


@pytest.fixture
def cell() -> SimulatedCell:
    return build_cell(PumpWorld.nominal(), camera="ray")


def run(cell: SimulatedCell, put: Drive, ticks: int) -> Sensed:
    return tick(cell.devices, put, ticks)


def place_arm(cell: SimulatedCell, x: float, y: float, z: float, yaw: float) -> None:
    """Put the hand at a place (in) with its finger line at `yaw` (rad), pointing down."""
    X = hand(x * INCH, y * INCH, z * INCH, yaw, math.pi / 2, 0.0)
    data = cell.truth.data
    q = solve(STANFORD, X, data.qpos[:6]).q
    assert q is not None
    data.qpos[:6] = q
    mujoco.mj_forward(cell.truth.model, data)


def history(seed: int) -> bytes:
    cell = build_cell(PumpWorld.sample(seed), camera="ray")
    parts = []
    for i in range(20):
        sensed = tick(cell.devices, Drive(torque=np.full(6, 0.1 * i)))
        parts.append(np.hstack([sensed.q, sensed.qd, sensed.gap, sensed.tool_torque]).tobytes())
    return b"".join(parts)


def test_one_seed_gives_the_same_bytes_twice() -> None:
    assert history(5) == history(5)


def test_two_seeds_give_different_readings() -> None:
    assert history(5) != history(6)


def test_a_tick_is_a_sixtieth_of_a_second(cell: SimulatedCell) -> None:
    assert run(cell, BRAKED, 60).time == pytest.approx(1.0, abs=1e-9)


def test_reading_twice_in_a_tick_gives_the_same() -> None:
    cell = build_cell(PumpWorld.sample(1), camera="ray")
    before, again = cell.devices.sense(), cell.devices.sense()
    assert (before.q.tobytes(), before.gap, before.tool_torque) == (
        again.q.tobytes(),
        again.gap,
        again.tool_torque,
    )


def test_brakes_hold_the_arm_for_ten_seconds(cell: SimulatedCell) -> None:
    before = cell.devices.sense().q
    assert np.abs(run(cell, BRAKED, 600).q - before).max() < 0.01 * DEGREE


@pytest.fixture
def steps(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Physics steps of every servo period from now on."""
    taken: list[int] = []
    step = mujoco.mj_step

    def counted(model: mujoco.MjModel, data: mujoco.MjData, number: int = 1) -> None:
        taken.append(number)
        step(model, data, number)

    monkeypatch.setattr(mujoco, "mj_step", counted)
    return taken


def test_only_time_passes_while_everything_sleeps(cell: SimulatedCell, steps: list[int]) -> None:
    run(cell, BRAKED, 60)
    before, stepped = cell.truth.data.qpos.copy(), len(steps)
    run(cell, BRAKED, 60)
    cell.advance(1.0)
    assert len(steps) == stepped
    assert cell.now == pytest.approx(3.0, abs=1e-9)
    assert (cell.truth.data.qpos == before).all()


def test_an_arm_that_is_driven_and_stands_still_stays_awake(cell: SimulatedCell) -> None:
    run(cell, Drive(torque=gravity(STANFORD, cell.devices.sense().q)), 60)
    assert cell.truth.data.ntree_awake == 1


def test_fingers_that_slept_go_where_they_are_told(cell: SimulatedCell) -> None:
    run(cell, BRAKED, 60)
    assert run(cell, replace(BRAKED, gap=3 * INCH), 90).gap == pytest.approx(3 * INCH, abs=5e-4)


def test_a_long_time_is_the_same_as_many_short_ones_to_fingers_under_way(cell: SimulatedCell) -> None:
    cell.devices.arm.drive(None)
    cell.devices.hand.drive(3 * INCH, STANFORD.hand.grip)
    cell.advance(15 * JIFFY)
    assert abs(cell.devices.hand.read().gap - 15 * JIFFY * STANFORD.hand.gap_speed) < 0.004


def test_without_brakes_or_torque_the_arm_falls(cell: SimulatedCell) -> None:
    before = cell.devices.sense().q
    assert np.abs(run(cell, LOOSE, 30).q - before).max() > 5 * DEGREE


def test_the_released_arm_stays_where_it_is_yet_yields_to_a_hand(cell: SimulatedCell) -> None:
    torque, before = gravity(STANFORD, cell.devices.sense().q), cell.devices.sense().q
    still = run(cell, Drive(torque=torque), 60).q
    cell.truth.data.xfrc_applied[cell.truth.model.body("stanford/link6").id, 1] = 13.0  # N, three pounds
    pushed = run(cell, Drive(torque=torque), 60).q
    assert np.abs(still - before).max() < 0.1 * DEGREE
    assert np.abs(pushed - still).max() > 2 * DEGREE


def test_row_34_an_arm_that_is_not_driven_anew_has_its_drives_cut_and_its_brakes_set(
    cell: SimulatedCell,
) -> None:
    torque, before = Drive(torque=gravity(STANFORD, cell.devices.arm.read().q)), cell.devices.arm.read().q
    assert not run(cell, torque, 1).braked
    cell.advance(JIFFY)
    assert cell.devices.arm.read().braked
    assert np.abs(run(cell, Drive(torque=np.full(6, 5.0)), 30).q - before).max() < 0.1 * DEGREE


def test_row_34_the_screwdriver_is_cut_with_the_arm(cell: SimulatedCell) -> None:
    turning = Drive(torque=gravity(STANFORD, cell.devices.arm.read().q), tool=10.0)
    run(cell, turning, 20)
    spun = cell.truth.data.joint("spindle").qvel[0]
    cell.advance(JIFFY)
    run(cell, turning, 20)
    assert abs(spun) > 5.0
    assert abs(cell.truth.data.joint("spindle").qvel[0]) < 0.5


def test_row_34_a_screwdriver_that_was_cut_stands_still_until_it_is_told_anew(cell: SimulatedCell) -> None:
    turning = Drive(torque=gravity(STANFORD, cell.devices.arm.read().q), tool=10.0)
    run(cell, turning, 20)
    cell.advance(JIFFY)
    cell.devices.arm.drive(None)
    cell.advance(30 * JIFFY)
    still = cell.truth.data.joint("spindle").qvel[0]
    run(cell, turning, 20)
    assert abs(still) < 0.5
    assert abs(cell.truth.data.joint("spindle").qvel[0]) > 5.0


def test_an_arm_holds_its_torque_for_a_servo_period_in_any_number_of_pieces(cell: SimulatedCell) -> None:
    cell.devices.arm.drive(gravity(STANFORD, cell.devices.arm.read().q))
    for _ in range(16):
        cell.advance(JIFFY / 16)
    assert not cell.devices.arm.read().braked
    cell.advance(JIFFY / 16)
    assert cell.devices.arm.read().braked


def test_brakes_put_out_by_the_program_acknowledge_a_missed_period(cell: SimulatedCell) -> None:
    run(cell, LOOSE, 1)
    cell.advance(JIFFY)
    run(cell, BRAKED, 1)
    assert not run(cell, LOOSE, 1).braked


def test_fingers_open_at_eight_centimetres_a_second(cell: SimulatedCell) -> None:
    start = run(cell, Drive(gap=0.02), 60).gap
    first = run(cell, Drive(gap=0.10), 15).gap
    last = run(cell, Drive(gap=0.10), 30).gap
    assert start == pytest.approx(0.02, abs=1e-3)
    assert (last - first) / (30 * JIFFY) == pytest.approx(0.08, rel=0.02)


def test_both_switches_fire_on_the_driver_and_the_gap_is_its_width(cell: SimulatedCell) -> None:
    place_arm(cell, 6.0, 33.0, 7.0, math.pi / 2)
    before = run(cell, Drive(gap=0.05), 20)
    after = run(cell, Drive(gap=0.0, grip=40.0), 40)
    assert (before.touch, after.touch) == ((False, False), (True, True))
    assert after.gap == pytest.approx(0.0254, abs=2e-4)


def test_a_grip_presses_with_the_force_that_was_asked_for(cell: SimulatedCell) -> None:
    run(cell, Drive(gap=0.05), 40)
    place_arm(cell, 6.0, 33.0, 7.0, math.pi / 2)
    run(cell, Drive(gap=0.0, grip=40.0), 60)
    forces = [cell.truth.data.sensor(f"stanford/switch_{side}").data[0] for side in "ab"]
    assert forces == pytest.approx([40.0, 40.0], abs=2.0)


def test_the_lamp_burns_only_while_it_is_on(cell: SimulatedCell) -> None:
    lamp = cell.truth.model.geom("stanford/lamp").matid[0]
    seen = []
    for on in (True, False):
        tick(cell.devices, Drive(lamp=on))
        seen.append(float(cell.truth.model.mat_emission[lamp]))
    assert seen == [1.0, 0.0]


def test_a_drive_that_is_not_a_number_is_refused(cell: SimulatedCell) -> None:
    with pytest.raises(InvalidInput, match=r"^the torque holds a value that is not a finite number$"):
        tick(cell.devices, Drive(torque=np.array([0, 0, np.nan, 0, 0, 0])))


def test_a_breakdown_of_the_physics_is_said_and_not_hidden(cell: SimulatedCell) -> None:
    cell.truth.data.qvel[:6] = 1e12
    with pytest.raises(PhysicsFailed, match=re.compile(r"^the simulated cell broke down \(mjWARN_\w+\)$")):
        run(cell, LOOSE, 2)


def test_a_resting_cell_sleeps(cell: SimulatedCell) -> None:
    run(cell, BRAKED, 60)
    assert cell.truth.data.ntree_awake == 0
