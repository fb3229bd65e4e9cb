"""LIFT takes the gasket from the base, by fingers that stand off the middle of its web."""

import numpy as np
import pytest
from pump_bench import MACROS, Bench, bench, shifted, stacked

from handeye.core.units import INCH

pytestmark = pytest.mark.slow

OFF = 0.14
"""How far (in) the hand is from the line of the large holes, as in the world of seed 972000. Beside the flats of the
base, closing fingers would meet the round walls of its holes.
"""


def lifted() -> Bench:
    lay = stacked()
    del lay["top"]
    positions = {name: shifted(name, y=OFF) for name in ("GON", "GOFF")}
    run = bench(f'{MACROS}\n        STAGE   "lift"\n        LIFT', positions=positions, lay=lay)
    run.run.state.saved["BARE"] = np.array([0.0, 0.0, -0.3 * INCH])  # FACE is .3 in over the face
    return run.go()


def test_the_gasket_comes_up_and_the_base_stays() -> None:
    run = lifted()
    assert run.finished, run.told
    assert run.place("gasket")[2] > 1.75 + 1.9
    assert run.moved("base") < 0.02
