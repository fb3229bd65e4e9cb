"""Kinematics for Python programs: what goes in comes out again, and what cannot be used is refused in a sentence."""

import re
from collections.abc import Callable

import numpy as np
import pytest

from handeye import arm
from handeye.core.errors import InvalidInput

Q = np.array([0.4, 0.5, 0.6, -0.3, 0.7, 0.2])


def test_inverse_finds_the_joints_that_forward_came_from() -> None:
    found = arm.inverse(arm.forward(Q), near=Q)
    assert found.q == pytest.approx(Q)


def test_a_pose_out_of_reach_has_a_reason_in_words() -> None:
    far = arm.forward(Q)
    far[0, 3] += 5.0
    found = arm.inverse(far)
    assert found.q is None
    assert found.message(arm.STANFORD).startswith("joint 3 (boom) would have to be at ")


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: arm.forward([1, 2]), "q must have shape (..., 6), not (2,)"),
        (lambda: arm.jacobian([np.nan] * 6), "q must consist of finite numbers, not [nan, nan, "),
        (lambda: arm.gravity("six"), "q must consist of finite numbers, not 'six'"),
        (
            lambda: arm.mass_matrix(Q, arm="Stanford"),
            "the arm must be an ArmModel, such as handeye.arm.STANFORD",
        ),  # type: ignore[arg-type]
        (lambda: arm.inverse(2 * np.eye(4)), "X_WT must be a pose: a rotation and a position in a matrix"),
        (lambda: arm.inverse(np.eye(4), near=[Q, Q]), "near must have shape (6,), not (2, 6)"),
    ],
)
def test_what_cannot_be_used_is_refused(call: Callable[[], object], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=re.escape(sentence)):
        call()
