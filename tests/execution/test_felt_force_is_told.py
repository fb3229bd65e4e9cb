"""Who looks on is told of every servo period: what is felt, where it is, and which guard watches."""

import numpy as np
import pytest
from fakes import FakeCell, Wall

from handeye.arm.kinematics import forward
from handeye.arm.line import straight
from handeye.arm.robots.stanford import STANFORD
from handeye.arm.samples import Samples
from handeye.core.units import INCH
from handeye.execution.compliance import Course
from handeye.execution.drive import ArmDrive
from handeye.execution.servo import Halted, ServoPeriod
from handeye.execution.state import DriveState
from handeye.program.guards import Force, GuardKind
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.touch.guards import monitor

DOWN = np.array([0.0, 0.0, -1.0])
SETTLE = STANFORD.servo.settle
LIMIT = 12.0


class Bench:
    """An arm over a wall, and what was told of it."""

    def __init__(self, wall: float = 0.2 * INCH) -> None:
        self.cell = FakeCell(np.array(PARK))
        x, y, z = forward(STANFORD, np.array(PARK))[:3, 3]
        self.cell.arm.walls = [Wall(point=(x, y, z - wall))]
        state = DriveState.holding(self.cell.devices.sense(), STANFORD)
        self.told: list[ServoPeriod] = []
        self.drive = ArmDrive(cell=self.cell.devices, arm=STANFORD, state=state, watch=self.told.append)

    def down(self) -> Samples:
        """An inch down."""
        way = straight(STANFORD, self.drive.state.q, INCH * DOWN, INCH)
        assert isinstance(way, Samples)
        return way


@pytest.fixture(scope="module")
def guarded() -> list[ServoPeriod]:
    """A motion down until it presses, and a moment of holding."""
    bench = Bench()
    bench.drive.follow(bench.down(), monitor((Force(force=(0.0, 0.0, -LIMIT)),)))
    bench.drive.hold(3)
    return bench.told


def test_nothing_is_told_to_be_felt_while_the_tare_is_taken_nor_when_the_motion_is_over(
    guarded: list[ServoPeriod],
) -> None:
    felt = [period.wrench is not None for period in guarded]
    assert felt == [False] * SETTLE + [True] * (len(guarded) - SETTLE - 3) + [False] * 3


def test_the_last_force_that_is_told_is_the_one_that_trips_the_guard(guarded: list[ServoPeriod]) -> None:
    pressing = [-period.wrench[2] for period in guarded if period.wrench is not None]
    assert all(force <= LIMIT for force in pressing[:-1])
    assert pressing[-1] > LIMIT


def test_the_guard_that_watches_is_told_wherever_force_is(guarded: list[ServoPeriod]) -> None:
    for period in guarded:
        kinds = [(guard.guard, guard.limit) for guard in period.guards]
        assert kinds == ([] if period.wrench is None else [(GuardKind.FORCE, LIMIT)])
        assert all(np.array_equal(guard.axis, DOWN) for guard in period.guards)


def test_a_free_motion_tells_of_no_force() -> None:
    bench = Bench(wall=9 * INCH)
    bench.drive.follow(bench.down())
    assert bench.told
    assert all(period.wrench is None and not period.guards for period in bench.told)


def test_a_hand_that_presses_without_a_guard_tells_its_force_alone() -> None:
    bench = Bench()
    pressing = Course(
        compliance=STANFORD.compliance, direction=DOWN, distance=0.1 * INCH, speed=INCH, force=4.0
    )
    bench.drive.comply(pressing, None)
    felt = [period for period in bench.told if period.wrench is not None]
    assert felt
    assert not any(period.guards for period in felt)


def test_under_the_panic_button_nothing_is_felt() -> None:
    bench = Bench()
    bench.drive.halt = lambda: len(bench.told) == SETTLE + 5
    with pytest.raises(Halted):
        bench.drive.follow(bench.down(), monitor((Force(force=(0.0, 0.0, -LIMIT)),)))
    assert bench.told[-2].wrench is not None
    assert bench.told[-1].wrench is None
    assert not bench.told[-1].effort.any()
