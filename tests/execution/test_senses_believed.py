"""No sense is doubted that is only as wrong as in a world of the high level: twice what its source says."""

import pytest
from pump_bench import bench

from handeye.core.variation import WorldSpec
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

ALL_SENSES = """
        OPEN    0
        OPEN    1
        MOVE    P1
        CENTER  .1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    P1UP
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] 1.2
        OPEN    1
        CHANGE  [0 0 1] 1
        LOOK    ONE
        LOOK    TWO
        MOVE    PARK
"""
"""A pin is drawn from its holder and put back; then the camera looks twice while the brakes hold the arm."""


@pytest.mark.parametrize("seed", [1, 2])
def test_no_sense_is_doubted_in_a_world_of_the_high_level(seed: int) -> None:
    world = PumpWorld.draw(WorldSpec(seed=seed, level="high"))
    assert bench(ALL_SENSES, world=world).go().errors == []
