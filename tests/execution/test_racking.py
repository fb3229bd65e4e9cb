"""RACK puts the screwdriver back into a rack that is turned against the hand."""

import pytest
from msgspec.structs import replace
from pump_bench import MACROS, TAUGHT, bench

from handeye.core.units import DEGREE
from handeye.program.events import SearchAdvanced

pytestmark = pytest.mark.slow

TAKEN_AND_PUT_BACK = f"{MACROS}        DRIVER  .25\n        RACK\n"
OVER_RACK = TAUGHT.positions["DUP"]
"""Where the hand holds the screwdriver over its rack."""


@pytest.mark.parametrize("degrees", [-3.5, 3.5])
def test_the_screwdriver_goes_into_a_turned_rack_without_a_search(degrees: float) -> None:
    """The block of the screwdriver has play for 2.3 degrees in the rack, and RACK turns the hand by 1.5 degrees."""
    x, y, z, o, a, t = OVER_RACK.at
    turned = replace(OVER_RACK, at=(x, y, z, o + degrees * DEGREE, a, t))
    run = bench(TAKEN_AND_PUT_BACK, positions={"DUP": turned}).go()
    assert run.finished
    assert run.all(SearchAdvanced) == []
