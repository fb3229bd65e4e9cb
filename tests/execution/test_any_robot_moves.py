"""The servo loop runs every robot in physics: it follows, feels, bears a load and stops, whatever the structure."""

import numpy as np
import pytest
from robot_bench import START, TOP, Bench
from robots import ROBOTS

from handeye.arm.kinematics import forward
from handeye.arm.line import straight
from handeye.arm.samples import Samples
from handeye.arm.trajectory import move
from handeye.core.pose import translated
from handeye.core.units import INCH
from handeye.execution.servo_loop import REACHED
from handeye.program.guards import Force, GuardKind
from handeye.touch.guards import monitor

pytestmark = pytest.mark.slow


@pytest.fixture(params=ROBOTS)
def bench(request: pytest.FixtureRequest) -> Bench:
    return Bench(request.param)


def line(bench: Bench, *way: float, speed: float = INCH) -> Samples:
    found = straight(bench.arm, bench.drive.state.q, np.array(way), speed)
    assert isinstance(found, Samples)
    return found


def test_it_follows_a_free_motion_and_a_straight_one(bench: Bench) -> None:
    goal = translated(START, (0.1, 0.0, 0.05))
    free = move(bench.arm, bench.drive.state.q, goal, speed=0.4)
    assert bench.drive.follow(free.sample(bench.arm.servo.period)) == REACHED
    np.testing.assert_allclose(bench.tool, goal[:3, 3], atol=1e-3)
    assert bench.drive.follow(line(bench, -0.05, 0.0, -0.02)) == REACHED
    np.testing.assert_allclose(bench.tool, goal[:3, 3] + [-0.05, 0.0, -0.02], atol=1e-3)


@pytest.mark.row(35, nominal=len(ROBOTS))
def test_row_35_a_second_of_motion_takes_sixty_torque_updates(bench: Bench) -> None:
    assert bench.drive.follow(line(bench, 0.0, 0.0, -0.9 * INCH)) == REACHED
    assert sum(time < 1.0 + bench.arm.servo.period / 2 for time in bench.ticks) == 60


def test_a_guarded_motion_ends_on_the_plate_with_the_force_it_names(bench: Bench) -> None:
    down = line(bench, 0.0, 0.0, -0.15)
    outcome = bench.drive.follow(down, monitor((Force(force=(0.0, 0.0, -12.0)),)), np.array([0.0, 0.0, -1.0]))
    assert outcome.trip is not None
    assert outcome.trip.guard is GuardKind.FORCE
    assert 12.0 < outcome.trip.value < 30.0
    assert bench.tool[2] == pytest.approx(TOP, abs=2e-3)


TWO_POUNDS = 8.9
"""Weight, N."""


def sunk(bench: Bench, seconds: float, *, declared: float, released: bool) -> float:
    """How far (m) the hand sinks under two pounds while it is let go of, or holds."""
    bench.drive.hold(10)
    before = bench.tool[2]
    bench.drive.state.load = declared
    bench.data.xfrc_applied[bench.link, 2] = -TWO_POUNDS
    if released:
        bench.drive.float(seconds)
    else:
        bench.drive.hold(round(seconds / bench.arm.servo.period))
    return float(before - bench.tool[2])


@pytest.mark.row(32, nominal=len(ROBOTS))
@pytest.mark.parametrize(("declared", "least", "most"), [(0.0, INCH, np.inf), (TWO_POUNDS, -2e-4, 2e-4)])
def test_row_32_a_released_arm_sinks_under_a_load_unless_it_is_declared(
    bench: Bench, declared: float, least: float, most: float
) -> None:
    assert least < sunk(bench, 1.0, declared=declared, released=True) < most


@pytest.mark.parametrize(("declared", "least", "most"), [(0.0, 5e-4, INCH), (TWO_POUNDS, -2e-4, 2e-4)])
def test_an_arm_that_holds_gives_way_to_a_load_unless_it_is_declared(
    bench: Bench, declared: float, least: float, most: float
) -> None:
    assert least < sunk(bench, 1.0, declared=declared, released=False) < most


def test_it_stands_where_it_is_when_its_brakes_are_set(bench: Bench) -> None:
    before = bench.tool
    bench.drive.brake(1.0)
    np.testing.assert_allclose(bench.tool, before, atol=1e-3)
    assert forward(bench.arm, bench.drive.state.q)[2, 3] == pytest.approx(before[2], abs=1e-3)
