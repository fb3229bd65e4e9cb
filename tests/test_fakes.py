"""The fake work cell is worth testing against."""

import numpy as np
import pytest
from fakes import FakeWorkcell, Wall

from handeye.arm.dynamics import gravity
from handeye.arm.kinematics import jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.ports.workcell import Drive
from handeye.pose import Array
from handeye.units import DEGREE, INCH, JIFFY

PARK = np.array([-19.7, 104.0, 0.0, 0.0, 76.0, 70.3]) * DEGREE + np.array([0, 0, 17.5 * INCH, 0, 0, 0])


def drive(torque: Array, *, gap: float = 0.05, brakes: bool = False) -> Drive:
    return Drive(torque=torque, brakes=brakes, gap=gap, grip=20.0, tool=0.0)


def test_the_fake_arm_rests_under_its_own_gravity_torque() -> None:
    cell = FakeWorkcell(q=PARK)
    for _ in range(60):
        cell.tick(drive(gravity(STANFORD, cell.sense().q)))
    assert np.abs(cell.sense().q - PARK).max() < 1e-6


def test_a_fake_wall_carries_what_presses_on_it() -> None:
    cell = FakeWorkcell(q=PARK)
    cell.walls.append(Wall(point=(0.0, 0.0, float(cell.tcp[2]))))
    for _ in range(90):
        J = jacobian(STANFORD, cell.sense().q)
        cell.tick(drive(gravity(STANFORD, cell.sense().q) + J.T @ np.array([0, 0, -20.0, 0, 0, 0])))
    assert cell.walls[0].force(cell.tcp, np.zeros(3))[2] == pytest.approx(20.0, abs=2.0)


def test_fake_fingers_close_on_what_stands_between_them() -> None:
    cell = FakeWorkcell(q=PARK, thickness=lambda p: 0.02)
    for _ in range(60):
        cell.tick(drive(np.zeros(6), gap=0.0, brakes=True))
    assert (cell.sense().gap, cell.sense().touch) == (0.02, (True, True))


def test_fake_time_is_exact_and_late_periods_set_the_brakes() -> None:
    cell = FakeWorkcell(q=PARK)
    cell.tick(drive(np.zeros(6)))
    cell.late()
    assert (cell.sense().time, cell.sense().braked) == (2 * JIFFY, True)
