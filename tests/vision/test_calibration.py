"""Calibrating the camera by spots the arm has shown it."""

from dataclasses import replace

import numpy as np
import pytest

from handeye.core.errors import InvalidInput
from handeye.core.units import DEGREE, INCH
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.vision.calibration import Sighting, calibrate
from handeye.vision.camera_model import CameraModel

TRUE = replace(
    DRAWING,
    mount=tuple(np.add(DRAWING.mount, (0.004, -0.003, 0.003))),
    pan0=0.2 * DEGREE,
    tilt0=-0.25 * DEGREE,
    roll=0.2 * DEGREE,
    lenses=tuple(
        replace(lens, scale=scale) for lens, scale in zip(DRAWING.lenses, (1.004, 0.997), strict=True)
    ),
)
BELT = np.array([44.5, 28.0, 3.0]) * INCH


def sightings(
    n: int, seed: int, *, arm: float = 0.1, lenses: tuple[float, ...] = (0.025, 0.050)
) -> list[Sighting]:
    """`n` spots for each lens about the belt; the arm is wrong by up to `arm` inches on each axis."""
    rng = np.random.default_rng(seed)
    seen = []
    for lens in lenses:
        for lamp in BELT + rng.uniform(-4, 4, (n, 3)) * (INCH, INCH, INCH / 2):
            pan, tilt = DRAWING.aim(lamp, lens)
            u, v = TRUE.view(lens, pan, tilt).project(lamp)[0] + rng.normal(0, 0.3, 2)
            told = tuple(lamp + rng.uniform(-arm, arm, 3) * INCH)
            seen.append(Sighting(lens=lens, pan=pan, tilt=tilt, u=u, v=v, point_W=told))
    return seen


def errors(model: CameraModel, height: float = 2.75 * INCH) -> np.ndarray:
    """How far off places on the belt are put with the 50 mm lens, m."""
    off = []
    for dx, dy in np.random.default_rng(0).uniform(-4, 4, (30, 2)) * INCH:
        place = np.array([BELT[0] + dx, BELT[1] + dy, height])
        pots = DRAWING.aim(place, 0.050)
        uv = TRUE.view(0.050, *pots).project(place)
        off.append((model.view(0.050, *pots).back_project(uv, height)[0] - place)[:2])
    return np.abs(off)


def test_a_camera_as_drawn_is_too_far_off():
    assert errors(DRAWING).max() > INCH / 4


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_twenty_spots_bring_it_within_a_quarter_of_an_inch(seed: int):
    assert errors(calibrate(sightings(20, seed), DRAWING).model).max() < INCH / 4


def test_a_perfect_arm_gives_a_near_perfect_camera():
    assert errors(calibrate(sightings(20, 1, arm=0.0), DRAWING).model).max() < 0.05 * INCH


def test_the_residual_shows_the_error_of_the_arm():
    calibration = calibrate(sightings(20, 2), DRAWING)
    assert 0.03 * INCH < calibration.residual_m < 0.2 * INCH
    assert set(calibration.residual_px) == {0.025, 0.050}
    assert calibration.residual_px[0.050] > calibration.residual_px[0.025]


def test_a_lens_never_seen_with_keeps_its_drawing():
    calibration = calibrate(sightings(12, 3, lenses=(0.025,)), DRAWING)
    assert calibration.model.lens(0.050).scale == pytest.approx(1.0, abs=1e-6)


def test_five_spots_are_too_few():
    with pytest.raises(InvalidInput, match=r"^5 sightings with the 25 mm lens; at least 6 are needed$"):
        calibrate(sightings(5, 0), DRAWING)


def test_no_spots_at_all_are_refused():
    with pytest.raises(InvalidInput, match=r"^there are no sightings to calibrate the camera with$"):
        calibrate([], DRAWING)
