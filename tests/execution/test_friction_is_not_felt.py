"""In free air the hand feels nothing, however its joints rub, as long as their friction is known."""

import numpy as np
import pytest
from released_arm import arm_alone

from handeye.arm.line import straight
from handeye.arm.robots.stanford import STANFORD
from handeye.arm.samples import Samples
from handeye.cell.compiled_arm import CompiledArm
from handeye.core.pose import Array
from handeye.core.units import INCH, OUNCE_FORCE
from handeye.execution.drive import ArmDrive
from handeye.execution.servo import ServoPeriod
from handeye.execution.state import DriveState
from handeye.program.guards import Force
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.touch.guards import monitor

pytestmark = pytest.mark.slow

UP, DOWN = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, -1.0])


def felt(seed: int, *, known: bool) -> Array:
    """Force of the hand (oz) on nothing, as it goes up two inches and down again, in periods of the way down."""
    world = PumpWorld.sample(seed)
    cell = arm_alone(world)
    state = DriveState.holding(cell.devices.sense(), STANFORD)
    if known:
        state.friction = world.arm_build.friction
    periods: list[ServoPeriod] = []
    drive = ArmDrive(
        cell=cell.devices, arm=STANFORD, state=state, watch=periods.append, arithmetic=CompiledArm
    )
    for way in (UP, DOWN):
        periods.clear()
        line = straight(STANFORD, state.q, 2 * INCH * way, INCH)
        assert isinstance(line, Samples)
        assert drive.follow(line, monitor((Force(force=(0.0, 0.0, -100.0)),)), way).error is None
    forces = [period.wrench @ [*DOWN, 0, 0, 0] for period in periods if period.wrench is not None]
    return np.array(forces) / OUNCE_FORCE


@pytest.mark.parametrize("seed", range(4))
def test_friction_that_is_known_is_not_felt(seed: int) -> None:
    forces = felt(seed, known=True)
    assert abs(np.mean(forces[10:])) < 3.0
    assert forces.max() < 12.0


@pytest.mark.parametrize("seed", range(4))
def test_friction_that_is_unknown_is_felt_as_twice_itself_where_the_hand_turns_back(seed: int) -> None:
    assert np.mean(felt(seed, known=False)[10:]) > 5.0
