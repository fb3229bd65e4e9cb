"""Finding the lamp on the hand."""

import cv2
import numpy as np
import pytest

from handeye.ports.camera import COLUMNS, ROWS
from handeye.vision.alignment import find_spot


def scene(seed: int, spots: tuple[tuple[float, float], ...] = ()) -> np.ndarray:
    rng = np.random.default_rng(seed)
    image = np.full((ROWS, COLUMNS), 5.0)
    image[:, 200:] = 9
    v, u = np.mgrid[0:ROWS, 0:COLUMNS]
    for u0, v0 in spots:
        image += 8 * np.exp(-((u - u0) ** 2 + (v - v0) ** 2) / (2 * 1.8**2))
    return np.clip(np.rint(image + rng.normal(0, 1, image.shape)), 0, 15).astype(np.uint8)


@pytest.mark.parametrize("place", [(50.3, 60.8), (121.0, 200.5), (300.6, 30.2)])
def test_the_lamp_is_found_to_half_a_point(place: tuple[float, float]):
    assert find_spot(scene(1), scene(2, (place,))) == pytest.approx(place, abs=0.5)


def test_noise_is_not_a_lamp():
    assert all(find_spot(scene(k), scene(k + 100)) is None for k in range(10))


def test_two_lamps_are_not_guessed_at():
    assert find_spot(scene(1), scene(2, ((60, 60), (150, 150)))) is None


def test_a_lamp_that_goes_out_is_not_found():
    assert find_spot(cv2.GaussianBlur(scene(2, ((60, 60),)), (0, 0), 0.5), scene(1)) is None
