"""The Robotics Toolbox has our arm as we have it, and `python -m benchmarks ik` finds it.

It is large, so the ordinary suite does without it: `pip install --group xcheck`, then `pytest tests/xcheck`.
"""

import numpy as np
import pytest
import roboticstoolbox

from benchmarks.inverse_kinematics import measure, toolbox_chain
from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import inverse


@pytest.mark.parametrize("seed", range(5))
def test_the_toolbox_puts_the_hand_where_we_do(seed: int) -> None:
    q = np.random.default_rng(seed).uniform(STANFORD.lower, STANFORD.upper)
    there = toolbox_chain(STANFORD).eval(q)
    assert there == pytest.approx(inverse(STANFORD.X_WB) @ forward(STANFORD, q), abs=1e-9)


def test_the_toolbox_is_measured_and_reaches_most_poses() -> None:
    compared = measure(STANFORD, 20, 1)
    toolbox = compared.others[-1]
    assert compared.missing == ()
    assert toolbox.name == f"ETS.ik_LM, roboticstoolbox {roboticstoolbox.__version__}"
    assert len(toolbox.errors) > 10
