"""Aligning two pictures that do not lie in quite the same place."""

import cv2
import numpy as np
import pytest

from handeye.ports.camera import COLUMNS, ROWS, Picture
from handeye.vision.alignment import aligned, shift


def picture(seed: int, by: tuple[float, float] = (0.0, 0.0), laid: bool = False) -> Picture:
    """Squares of two greys, so many points (columns, rows) off, with a dark thing laid on them, or without."""
    v, u = np.mgrid[0 : 4 * ROWS, 0 : 4 * COLUMNS] / 4
    squares = np.where(((u - by[0]) // 37 + (v - by[1]) // 29) % 2, 4.0, 11.0)
    image = squares.reshape(ROWS, 4, COLUMNS, 4).mean(axis=(1, 3))
    if laid:
        image[60:200, 80:260] = 0.0
    soft = cv2.GaussianBlur(image, (0, 0), 0.6)
    noise = np.random.default_rng(seed).normal(0, 1, image.shape)
    return np.clip(np.rint(soft + noise), 0, 15).astype(np.uint8)


@pytest.mark.parametrize("by", [(0.0, 0.0), (1.5, -2.0), (-3.0, 2.5)])
@pytest.mark.parametrize("laid", [False, True])
def test_a_shift_is_found_to_a_twentieth_of_a_point_whatever_else_has_changed(
    by: tuple[float, float], laid: bool
):
    assert shift(picture(1), picture(2, by, laid)) == pytest.approx(by, abs=0.05)


def test_a_shift_is_told_by_the_points_that_are_named():
    first, second = picture(1), picture(2, (1.0, 2.0))
    second[:, 166:] = picture(3, (-2.0, 0.0))[:, 166:]
    left = np.zeros(first.shape, np.bool_)
    left[:, :150] = True
    right = left[:, ::-1]
    assert shift(first, second, left) == pytest.approx((1.0, 2.0), abs=0.1)
    assert shift(first, second, right) == pytest.approx((-2.0, 0.0), abs=0.1)


def test_aligned_pictures_differ_by_noise_and_by_what_has_changed():
    first, second = picture(1), picture(2, (2.0, -1.0), laid=True)
    off = np.abs(aligned(second, to=first) - first)
    assert np.median(off[100:160, 110:200]) > 3
    assert off[10:50, 10:300].mean() < 1.2


def test_pictures_without_any_edge_are_left_where_they_are():
    grey = np.full((ROWS, COLUMNS), 7, np.uint8)
    assert np.array_equal(aligned(grey, to=grey), grey)
