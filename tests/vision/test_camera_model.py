"""The camera model: where points fall in the picture, and back."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from handeye.core.errors import InvalidInput
from handeye.core.units import DEGREE, INCH
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.vision.camera_model import CENTRE, CameraModel, LensModel

TILTED = CameraModel(
    mount=(0.9, 1.7, 1.4),
    pan0=0.01,
    tilt0=-0.02,
    roll=0.03,
    lenses=(LensModel(focal_length=0.025, scale=1.01, forward=0.05, up=0.02),),
)

table = st.tuples(st.floats(0.2, 1.3), st.floats(0.2, 1.2), st.floats(0.0, 0.3))


@given(point=table)
def test_the_camera_puts_what_it_aims_at_in_the_middle(point):
    uv = TILTED.view(0.025, *TILTED.aim(point, 0.025)).project(np.array(point))[0]
    assert uv == pytest.approx(CENTRE, abs=0.01)


@given(point=table)
def test_back_projection_undoes_projection(point):
    view = TILTED.view(0.025, 0.1, 0.8)
    again = view.back_project(view.project(np.array(point)), point[2])[0]
    assert again == pytest.approx(point, abs=1e-9)


def test_columns_grow_against_table_x_and_rows_towards_the_camera():
    view = DRAWING.view(0.025, *DRAWING.aim((0.86, 0.9, 0.0), 0.025))
    middle, right, nearer = view.project(np.array([[0.86, 0.9, 0], [0.76, 0.9, 0], [0.86, 1.0, 0]]))
    assert right[0] > middle[0]
    assert nearer[1] > middle[1]


def test_the_50_mm_lens_resolves_a_twentieth_of_an_inch_on_the_belt():
    belt = (44.5 * INCH, 28 * INCH, 0.0)
    across, down = DRAWING.view(0.050, *DRAWING.aim(belt, 0.050)).resolution(np.array(belt))
    assert 1 / across == pytest.approx(0.051 * INCH, rel=0.05)
    assert 1 / down == pytest.approx(0.063 * INCH, rel=0.05)


def test_tilt_turns_the_camera_down():
    assert DRAWING.view(0.025, 0, 45 * DEGREE).X_WC[2, 2] < DRAWING.view(0.025, 0, 0).X_WC[2, 2]


def test_a_lens_that_is_not_in_the_turret_is_refused():
    with pytest.raises(InvalidInput, match=r"^the turret has no 35 mm lens; it has 25 mm and 50 mm$"):
        DRAWING.view(0.035, 0, 0)


def test_a_lens_stands_where_its_drawing_says_from_the_crossing_of_the_axes():
    model = replace(DRAWING, lenses=(LensModel(focal_length=0.05, forward=0.1, up=0.03),))
    off = model.view(0.05, 0.0, 0.0).X_WC[:3, 3] - model.mount
    assert off == pytest.approx((0.0, -0.1, 0.03))


@pytest.mark.parametrize("focal", [0.0, -0.05, 1e9, math.nan])
def test_no_lens_has_a_focal_length_that_would_ask_for_endless_pictures(focal: float) -> None:
    with pytest.raises(ValueError, match=r"^no lens has a focal length of .* m$"):
        LensModel(focal_length=focal, forward=0.1, up=0.03)
