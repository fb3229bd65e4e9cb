import math

import numpy as np
import pytest

from handeye.core.pose import displaced, planar, pose, rotation, rotation_x, rotation_z


@pytest.mark.parametrize("angle", [-3.0, -1e-9, 0.0, 0.3, math.pi])
def test_a_rotation_vector_turns_about_itself_by_its_length(angle: float) -> None:
    np.testing.assert_allclose(rotation(np.array([angle, 0, 0])), rotation_x(angle), atol=1e-15)
    np.testing.assert_allclose(rotation(np.array([0, 0, angle])), rotation_z(angle), atol=1e-15)


def test_a_displaced_pose_turns_on_the_spot() -> None:
    X = displaced(planar(1, 2, 3, 0.2), np.array([0, 0, 1]), np.array([0, 0, 0.3]))
    np.testing.assert_allclose(X, planar(1, 2, 4, 0.5), atol=1e-15)


def test_a_pose_that_is_not_displaced_is_the_same_to_the_bit() -> None:
    X = pose(rotation(np.array([0.1, 0.2, 0.3])), np.array([0.4, 0.5, 0.6]))
    assert (displaced(X, np.zeros(3), np.zeros(3)) == X).all()
