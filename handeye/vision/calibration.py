"""Calibrates the camera to the arm. The arm carries a lamp through the view of the camera, and the camera model is
fitted to the spots of the lamp in the pictures.

The arm holds the lamp at known places, and the camera sees the lamp through both lenses. The fit uses these sightings,
and priors that correspond to the accuracy of a careful mechanic. The error of the arm, about a tenth of an inch,
limits the accuracy of the fit. The residual of the fit shows this error.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Final

import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.core.pose import Array
from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH
from handeye.vision.camera_model import CameraModel, View


@dataclass(frozen=True, slots=True, kw_only=True)
class CalibrationLook:
    """A camera setting, and the places (m, in W) at which the arm shows the lamp to the camera in this setting."""

    lens: float  # focal length, m
    at: Vector3  # aim
    sharp: Vector3
    """The point in focus. Neighbouring looks share this point, because refocusing takes three times as long as
    aiming.
    """
    places: tuple[Vector3, ...]
    hand_angle: float  # angle O of the hand, pointing down, rad


PLACE_PRIOR: Final = 0.5 * INCH  # sigma, of the mount and of the lens offsets
TURN_PRIOR: Final = 2 * DEGREE  # sigma, of pan, tilt and roll
SCALE_PRIOR: Final = 0.01  # sigma, of the focal lengths
SIGHT_ERROR: Final = 0.13 * INCH  # .1 in of the arm, and .07 deg of the potentiometers at 65 in
"""Standard deviation (m) of a sighting. PLACE_PRIOR, TURN_PRIOR and SCALE_PRIOR are weak priors (vision study, section
3).
"""
MIN_SIGHTINGS: Final = 6
"""Least number of sightings for each lens. With fewer sightings, the priors dominate; 12 to 20 sightings are good."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sighting:
    """A picture of the lamp at a known place. The lamp appears at (u, v) in the picture."""

    lens: float  # focal length, m
    pan: float  # potentiometer reading, rad, as tilt
    tilt: float
    u: float
    v: float
    point_W: tuple[float, float, float]  # position that the arm measured, m


@dataclass(frozen=True, slots=True, kw_only=True)
class Calibration:
    """A fitted camera model, and the root mean square (RMS) residuals of the sightings."""

    model: CameraModel
    residual_px: dict[float, float]  # in the picture, by focal length (m)
    residual_m: float  # horizontal, at the height of each lamp


def calibrate(sightings: Sequence[Sighting], drawing: CameraModel) -> Calibration:
    """Fit the camera model to the sightings, starting from the values of the design. A lens without sightings keeps
    the values of the design.
    """
    from scipy.optimize import least_squares

    used = sorted({drawing.lens(s.lens).focal_length for s in sightings})
    for focal_length in used:
        count = sum(drawing.lens(s.lens).focal_length == focal_length for s in sightings)
        if count < MIN_SIGHTINGS:
            raise BadArgument(
                f"{counted(count, 'sighting')} with the {focal_length * 1000:.0f} mm lens; "
                f"at least {MIN_SIGHTINGS} are needed"
            )
    if not used:
        raise BadArgument("there are no sightings to calibrate the camera with")
    start = np.zeros(6 + 3 * len(drawing.lenses))

    def residuals(x: Array) -> Array:
        view_of = cache(moved(drawing, x).view)  # many sightings share a view
        misses = []  # distances of the lamp from the line of sight, along columns and rows, m
        for s in sightings:
            view = view_of(s.lens, s.pan, s.tilt)
            distance = float(np.linalg.norm(np.array(s.point_W) - view.X_WC[:3, 3]))
            misses.append(_miss_px(view, s) / view.focal * distance / SIGHT_ERROR)
        return np.concatenate([*misses, x])

    fit = least_squares(residuals, start, method="trf", xtol=1e-10, ftol=1e-12)
    model = moved(drawing, fit.x)
    return Calibration(
        model=model,
        residual_px={
            f: _rms([_miss_px(_view(model, s), s) for s in sightings if np.isclose(s.lens, f)]) for f in used
        },
        residual_m=_rms(
            [
                (_view(model, s).back_project(np.array([s.u, s.v]), s.point_W[2])[0] - s.point_W)[:2]
                for s in sightings
            ]
        ),
    )


def moved(drawing: CameraModel, x: Array) -> CameraModel:
    """Change the parameters of the design by `x`, given in standard deviations of the priors."""
    mount = np.array(drawing.mount) + x[:3] * PLACE_PRIOR
    lenses = tuple(
        replace(
            lens,
            scale=lens.scale + float(a) * SCALE_PRIOR,
            forward=lens.forward + float(b) * PLACE_PRIOR,
            up=lens.up + float(c) * PLACE_PRIOR,
        )
        for lens, (a, b, c) in zip(drawing.lenses, x[6:].reshape(-1, 3), strict=True)
    )
    return CameraModel(
        mount=(float(mount[0]), float(mount[1]), float(mount[2])),
        pan0=drawing.pan0 + float(x[3]) * TURN_PRIOR,
        tilt0=drawing.tilt0 + float(x[4]) * TURN_PRIOR,
        roll=drawing.roll + float(x[5]) * TURN_PRIOR,
        lenses=lenses,
    )


def _view(model: CameraModel, s: Sighting) -> View:
    return model.view(s.lens, s.pan, s.tilt)


def _miss_px(view: View, s: Sighting) -> Array:
    return np.asarray(view.project(np.array(s.point_W))[0] - (s.u, s.v))


def _rms(misses: list[Array]) -> float:
    return float(np.sqrt(np.mean(np.sum(np.square(misses), axis=1))))
