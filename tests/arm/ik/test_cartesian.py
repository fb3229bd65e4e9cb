"""Any subset of three square slides goes where it can, and says what it cannot."""

import math
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from robots import SMALL_HAND, YIELDING

from handeye.arm.ik import solve
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel, Joint, ServoModel
from handeye.core.pose import Array, pose, rotation_z, translated
from handeye.core.units import DEGREE, INCH
from handeye.program.diagnosis.reach import FixedDirection, FixedOrientation

AXES = {"x": np.array([1.0, 0.0, 0.0]), "y": np.array([0.0, 1.0, 0.0]), "z": np.array([0.0, 0.0, -1.0])}
SUBSETS = [names for count in (1, 2, 3) for names in combinations("xyz", count)]


def angle(a: Array, b: Array, about: Array) -> float:
    """From a to b."""
    return math.atan2(float(np.cross(a, b) @ about), float(a @ b))


def slides(names: tuple[str, ...]) -> ArmModel:
    """An arm of slides whose hand points down; its Denavit-Hartenberg angles are worked out from the axes."""
    z, joints = AXES[names[0]], []
    x = np.array([0.0, 0.0, 1.0]) if names[0] != "z" else np.array([1.0, 0.0, 0.0])
    X_WB = pose(np.stack([x, np.cross(z, x), z], axis=1), (0.2, 0.3, 0.9))
    for name, following in zip(names, [*(AXES[n] for n in names[1:]), AXES["z"]], strict=True):
        across = np.cross(z, following)
        x_next = across if across.any() else x
        joints.append(
            Joint(
                name=name, kind="prismatic", d=0.0, theta=angle(x, x_next, z), alpha=angle(z, following, x_next),
                lower=0.0, upper=0.8, speed=1.0, acceleration=2.0, effort=100.0, mass=1.0, centre=(0.0, 0.0, 0.0),
                inertia=(0.01, 0.01, 0.01), armature=1.0, damping=1.0, brake=200.0,
            )
        )  # fmt: skip
        x, z = x_next, following
    figures = (1.0,) * len(names)
    servo = ServoModel(period=1 / 60, frequency=figures, lag=figures, short=0.004, settle=8, drag=0.1)
    return ArmModel(
        name="slides", structure="cartesian", joints=tuple(joints), X_WB=X_WB, hand=SMALL_HAND, servo=servo,
        compliance=replace(YIELDING, friction=(1.0,) * len(names)),
    )  # fmt: skip


@pytest.mark.parametrize("names", SUBSETS, ids="".join)
def test_the_hand_goes_along_the_axes_there_are(names: tuple[str, ...]) -> None:
    arm = slides(names)
    q = np.array([0.1, 0.2, 0.3])[: len(names)]
    X = forward(arm, q)
    np.testing.assert_allclose(X[:3, 2], [0, 0, -1], atol=1e-12)
    np.testing.assert_allclose(
        X[:3, 3], np.array([0.2, 0.3, 0.9]) + sum(x * AXES[n] for x, n in zip(q, names, strict=True))
    )
    np.testing.assert_allclose(solve(arm, X, arm.middle).q, q, atol=1e-12)


@pytest.mark.parametrize("names", SUBSETS, ids="".join)
def test_it_is_refused_in_words_where_there_is_no_axis(names: tuple[str, ...]) -> None:
    arm = slides(names)
    X = forward(arm, arm.middle)
    for name in {*"xyz"} - {*names}:
        refused = solve(arm, translated(X, 2 * INCH * AXES[name]), arm.middle)
        assert isinstance(refused.reason, FixedDirection)
        way = "line on which joint 1" if len(names) == 1 else "plane in which joint 1"
        assert f"the hand would have to be 2.00 in off the {way}" in refused.message(arm)
    turned = X.copy()
    turned[:3, :3] = rotation_z(20 * DEGREE) @ X[:3, :3]
    refused = solve(arm, turned, arm.middle)
    assert isinstance(refused.reason, FixedOrientation)
    assert refused.message(arm) == (
        "the hand would have to turn by 20.0 degrees about an axis for which the slides arm has no joint"
    )


@pytest.mark.parametrize("structure", ["spherical wrist", "gantry"])
def test_an_arm_that_is_built_otherwise_than_it_says_is_not_solved(structure: str) -> None:
    arm = replace(slides(("x", "y", "z")), structure=structure)
    with pytest.raises(ValueError, match=r"^the slides arm "):
        solve(arm, np.eye(4), arm.middle)
