"""The places at which the last stage pushes the pump to its blocks, and feels the heads of its screws."""

import numpy as np
import pytest

from handeye.arm.robots.stanford import STANFORD
from handeye.core.resources import plans
from handeye.core.units import INCH
from handeye.planfile.store import read_plan
from handeye.program.motion_operations import Height
from handeye.program.taught import load_taught
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, screw_holes

LEAN = 0.05 * INCH  # m: of a palm 1.5 in aside, the hand tilted by two degrees
SCATTER = 0.02 * INCH  # m: of a felt height, four sigma
GIVES = 0.0055 * INCH  # m: by what six screws press gasket, flange and heads into one another


@pytest.mark.parametrize("rim", ["RIM1", "RIM2"])
def test_at_the_felt_height_fingers_reach_the_casting_and_the_palm_passes_the_crank(rim: str) -> None:
    d, taught = dimensions(), load_taught(plans() / "water_pump.toml").positions
    lowered = taught["FACE"].at[2] - base_top()  # by RESTORE BARE
    tip = taught[rim].at[2] - lowered
    rotor = d("top.hub_height") + d("rotor.arm_height") + d("rotor.crank_height")
    crank = base_top() + d("gasket.thickness") + d("top.flange") + rotor
    assert tip - STANFORD.hand.palm[5] > crank + LEAN + SCATTER
    assert tip < base_top() - LEAN - SCATTER


@pytest.mark.parametrize("beside", [0.0, 0.06])
@pytest.mark.parametrize("hole", range(6))
def test_closed_fingers_meet_the_head_and_clear_the_hub_by_more_than_they_are_off(
    hole: int, beside: float
) -> None:
    d, hand = dimensions(), STANFORD.hand
    x, y, z = load_taught(plans() / "water_pump.toml").positions[f"HEAD{hole}"].at[:3]
    hx, hy = screw_holes(6)[hole]
    away = np.abs((x - hx, y - beside * INCH - hy)) - (hand.finger_width / 2, hand.finger_thickness)
    assert (away < 0).all()  # the middle of the head is under them
    beside = abs(x) - hand.finger_width / 2 - d("top.hub_length") / 2
    assert beside > LEAN + SCATTER
    top = base_top() + d("gasket.thickness") + d("top.flange") + d("screw.head_height")
    assert z - 0.3 * INCH - top > 4 * SCATTER  # where they begin


def test_the_last_stage_allows_of_each_head_the_drawn_height_less_what_the_layers_give() -> None:
    d, program = dimensions(), read_plan(plans() / "water_pump.plan.json").program
    heads = [
        one.operation for one in program.steps if one.macro == "HEAD" and isinstance(one.operation, Height)
    ]
    allowed = {(one.minimum, one.maximum) for one in heads if one.maximum < INCH}
    ((low, high),) = allowed
    drawn = d("gasket.thickness") + d("top.flange") + d("screw.head_height")
    assert (low + high) / 2 == pytest.approx(drawn - GIVES, abs=0.001 * INCH)
    assert high - drawn < 0.5 * d("screw.pitch")  # half a turn is noticed
