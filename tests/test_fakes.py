"""The fake work cell is worth testing against."""

import numpy as np
import pytest
from compiled_mechanics import CompiledMechanics
from driving import Drive, tick
from fakes import FakeArm, FakeAxes, FakeCell, FakeClock, Wall, by_formulas

from handeye.arm.dynamics import gravity
from handeye.arm.kinematics import jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import InvalidInput
from handeye.core.units import DEGREE, INCH, JIFFY
from handeye.ports.axes import AxisSpec
from handeye.ports.workcell import Workcell

PARK = np.array([-19.7, 104.0, 0.0, 0.0, 76.0, 70.3]) * DEGREE + np.array([0, 0, 17.5 * INCH, 0, 0, 0])


def test_the_fake_arm_rests_under_its_own_gravity_torque() -> None:
    cell = FakeCell(PARK)
    for _ in range(60):
        tick(cell.devices, Drive(torque=gravity(STANFORD, cell.arm.q)))
    assert np.abs(cell.arm.q - PARK).max() < 1e-6


def test_the_mechanics_in_c_are_those_of_the_formulas() -> None:
    rng, compiled = np.random.default_rng(0), CompiledMechanics()
    for _ in range(20):
        q, qd = PARK + rng.normal(0, 0.2, 6), rng.normal(0, 1, 6)
        for one, other in zip(compiled(q, qd), by_formulas(q, qd), strict=True):
            np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-9)


def test_a_fake_wall_carries_what_presses_on_it() -> None:
    cell = FakeCell(PARK)
    cell.arm.walls.append(Wall(point=(0.0, 0.0, float(cell.arm.tcp[2]))))
    for _ in range(90):
        pressing = jacobian(STANFORD, cell.arm.q).T @ np.array([0, 0, -20.0, 0, 0, 0])
        tick(cell.devices, Drive(torque=gravity(STANFORD, cell.arm.q) + pressing))
    assert cell.arm.walls[0].force(cell.arm.tcp, np.zeros(3))[2] == pytest.approx(20.0, abs=2.0)


def test_fake_fingers_close_on_what_stands_between_them() -> None:
    cell = FakeCell(PARK)
    cell.hand.thickness = lambda p: 0.02
    read = tick(cell.devices, Drive(gap=0.0), ticks=60)
    assert (read.gap, read.touch) == (0.02, (True, True))


def test_fake_time_is_exact_and_a_fake_arm_that_is_not_driven_anew_sets_its_brakes() -> None:
    cell = FakeCell(PARK)
    tick(cell.devices, Drive(torque=np.zeros(6)))
    cell.clock.advance(JIFFY)
    assert (cell.clock.now, cell.arm.read().braked) == (2 * JIFFY, True)


def test_time_passes_in_whole_physics_steps_only() -> None:
    with pytest.raises(
        InvalidInput, match=r"^a period of 0.0035 s is not a whole number of physics steps of "
    ):
        FakeClock().advance(0.0035)


def test_a_lack_of_devices_reads_as_nothing() -> None:
    arm = FakeArm(PARK)
    read = Workcell(clock=FakeClock(arm), arm=arm).sense()
    assert (read.gap, read.touch, read.tool_torque) == (0.0, (False, False), 0.0)


def gantry(clock: FakeClock) -> FakeAxes:
    spec = AxisSpec(name="x", kind="prismatic", lower=0.0, upper=1.0, speed=0.5)
    return FakeAxes(clock, spec)


def test_axes_go_where_they_are_told_by_themselves_within_their_limits() -> None:
    axes = gantry(clock := FakeClock())
    axes.put(np.array([3.0]))
    clock.advance(1.0)
    assert axes.read().q == pytest.approx([0.5])
    clock.advance(5.0)
    assert axes.read().q == pytest.approx([1.0])


def test_axes_read_twice_within_a_step_give_the_same() -> None:
    axes = gantry(FakeClock())
    axes.felt["left finger"] = 0.56
    axes.put(np.array([1.0]))
    first, second = axes.read(), axes.read()
    assert (first.time, first.q, first.channels) == (second.time, second.q, second.channels)
