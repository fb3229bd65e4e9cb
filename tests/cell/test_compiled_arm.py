"""The arithmetic of an arm in C says what the formulas say."""

from collections.abc import Callable

import numpy as np
import pytest
from arm_in_mujoco import postures
from robots import ROBOTS

from handeye.arm.arithmetic import Formulas
from handeye.arm.model import ArmModel
from handeye.arm.weighing import weighed
from handeye.cell.compiled_arm import CompiledArm

CLOSE = 1e-12
"""m, N m, N and kg m2, beside figures of some hundreds."""


@pytest.fixture(params=ROBOTS)
def arm(request: pytest.FixtureRequest) -> ArmModel:
    """An arm whose links have been weighed."""
    drawn = ROBOTS[request.param].arm
    return weighed(drawn, tuple(np.linspace(0.9, 1.2, len(drawn.joints)).tolist()))


@pytest.mark.parametrize(
    "found",
    [
        lambda it, q: it.forward(q),
        lambda it, q: it.gravity(q),
        lambda it, q: it.at_rest(q).M,
        lambda it, q: it.at_rest(q).bias,
        lambda it, q: it.at_rest(q).J,
        lambda it, q: it.statics(q)[0],
        lambda it, q: it.statics(q)[1],
    ],
    ids=["forward", "gravity", "inertia", "bias", "jacobian", "weight alone", "jacobian alone"],
)
def test_it_agrees_with_the_formulas_wherever_the_arm_stands(
    arm: ArmModel, found: Callable[..., np.ndarray]
) -> None:
    one, other = CompiledArm(arm), Formulas(arm)
    for q in postures(arm, 50):
        np.testing.assert_allclose(found(one, q), found(other, q), rtol=0, atol=CLOSE)


def test_the_same_posture_gives_the_same_bytes_whatever_was_computed_before(arm: ArmModel) -> None:
    here, there = postures(arm, 2)
    fresh, used = CompiledArm(arm), CompiledArm(arm)
    first = fresh.at_rest(here)
    used.at_rest(there)
    again = used.at_rest(here)
    used.at_rest(there)  # what was returned is not overwritten
    assert [x.tobytes() for x in (first.M, first.bias, first.J)] == [
        x.tobytes() for x in (again.M, again.bias, again.J)
    ]
    assert used.forward(here).tobytes() == fresh.forward(here).tobytes()
