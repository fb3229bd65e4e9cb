"""The line of a grasp in a picture, from finger to finger."""

import numpy as np
import pytest
from synthetic import part, view

from handeye.core.pose import hand
from handeye.core.units import DEGREE, INCH
from handeye.vision.marks import grasp_line

PART = part()
FACE = PART.at[2] + PART.face
WHERE = view(0.050, (*PART.at[:2], FACE))


def hand_over(x: float, o: float) -> np.ndarray:
    """A hand that points down an inch over the face, so far (in) from the middle of the picture, turned (deg)."""
    return hand(PART.at[0] + x * INCH, PART.at[1], FACE + INCH, o * DEGREE, 90 * DEGREE, 0.0)


@pytest.mark.parametrize("o", [0.0, 30.0, 90.0])
def test_the_line_lies_on_the_face_as_long_as_the_hand_is_open(o: float) -> None:
    line = grasp_line(WHERE, hand_over(0.0, o), 1.8 * INCH, FACE)
    (a, b) = WHERE.back_project(np.array(line), FACE)
    assert (a + b) / 2 == pytest.approx([*PART.at[:2], FACE])
    assert np.abs(b - a) / INCH == pytest.approx(
        [1.8 * np.cos(o * DEGREE), 1.8 * np.sin(o * DEGREE), 0.0], abs=1e-6
    )


def test_a_line_that_is_not_all_in_the_picture_is_left_out() -> None:
    assert grasp_line(WHERE, hand_over(12.0, 0.0), 1.8 * INCH, FACE) is None
