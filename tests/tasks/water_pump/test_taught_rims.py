"""The places beside the pump's rim, whence the last stage pushes it to its blocks."""

import pytest

from handeye.arm.robots.stanford import STANFORD
from handeye.core.resources import plans
from handeye.core.units import INCH
from handeye.program.taught import load_taught
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions

LEAN = 0.05 * INCH  # m: of a palm 1.5 in aside, the hand tilted by two degrees
SCATTER = 0.02 * INCH  # m: of a felt height, four sigma


@pytest.mark.parametrize("rim", ["RIM1", "RIM2"])
def test_at_the_felt_height_fingers_reach_the_casting_and_the_palm_passes_the_crank(rim: str) -> None:
    d, taught = dimensions(), load_taught(plans() / "water_pump.toml").positions
    lowered = taught["FACE"].at[2] - base_top()  # by RESTORE BARE
    tip = taught[rim].at[2] - lowered
    rotor = d("top.hub_height") + d("rotor.arm_height") + d("rotor.crank_height")
    crank = base_top() + d("gasket.thickness") + d("top.flange") + rotor
    assert tip - STANFORD.hand.palm[5] > crank + LEAN + SCATTER
    assert tip < base_top() - LEAN - SCATTER
