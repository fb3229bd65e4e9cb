"""The raster of the tube: its shape, and that no picture lies quite where the one before lay."""

import numpy as np
import pytest

from handeye.cell.raster import MIDDLE, Raster
from handeye.ports.camera import COLUMNS, ROWS

CORNER = np.array([COLUMNS - 0.5, ROWS - 0.5])
BENT = Raster(pincushion=0.01, lines=-0.008, field=0.006)
STILL = np.zeros(2)


def dots(*places: tuple[int, int]) -> np.ndarray:
    light = np.zeros((ROWS, COLUMNS), np.float32)
    for u, v in places:
        light[v, u] = 1
    return light


def test_an_even_raster_shows_the_light_as_it_falls():
    light = np.random.default_rng(0).random((ROWS, COLUMNS), np.float32)
    assert np.array_equal(Raster().read(light, STILL), light)


def test_pincushion_draws_a_corner_in_by_its_share():
    inwards = CORNER - Raster(pincushion=0.01).shown(CORNER)
    assert inwards == pytest.approx(0.01 * (CORNER - MIDDLE), rel=0.05)


def test_an_uneven_line_is_off_in_the_middle_and_right_at_its_ends():
    raster = Raster(lines=0.01)
    assert raster.target(MIDDLE) - MIDDLE == pytest.approx((0.01 * COLUMNS / 2, 0))
    assert raster.target(CORNER) == pytest.approx(CORNER)


def test_a_spot_is_shown_where_it_is_said_to_be():
    picture = BENT.read(dots((300, 220)), STILL)
    v, u = np.mgrid[0:ROWS, 0:COLUMNS]
    centre = (picture * u).sum() / picture.sum(), (picture * v).sum() / picture.sum()
    assert centre == pytest.approx(BENT.shown(np.array([300.0, 220.0])), abs=0.1)


def test_a_picture_that_lies_off_shows_everything_off():
    picture = Raster().read(dots((100, 80)), np.array([3.0, -2.0]))
    assert np.argwhere(picture > 0.9).tolist() == [[78, 103]]
