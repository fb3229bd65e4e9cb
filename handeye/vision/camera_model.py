"""The television camera model: a pan/tilt mount, a two-lens turret, a raster of points.

Camera frame C has x along the lines (in the direction of increasing column u), y down the picture (increasing row v),
and z forward. Coordinates (u, v) of the picture start at the centre of the first point of the first line. At pan 0 and
tilt 0, the camera looks along -y of the table. Positive pan turns the camera counter-clockwise, seen from above.
Positive tilt turns the camera downwards.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.pose import Array, Pose, pose
from handeye.ports.camera import COLUMNS, RASTER, ROWS

CENTRE: Final = ((COLUMNS - 1) / 2, (ROWS - 1) / 2)
MIN_FOCAL_LENGTH: Final = 0.001
MAX_FOCAL_LENGTH: Final = 1.0


def in_picture(points: Array) -> bool:
    """Return True if all points (u, v), shape (n, 2), lie within the picture."""
    return bool(np.all((points >= 0) & (points <= (COLUMNS - 1, ROWS - 1))))


@dataclass(frozen=True, slots=True, kw_only=True)
class LensModel:
    """A lens of the turret, with the offsets (m) of its centre of projection from the point where the pan and tilt
    axes cross.
    """

    focal_length: float  # as engraved, m; names the lens
    scale: float = 1.0  # true over engraved focal length
    forward: float  # along the line of sight
    up: float  # in the picture
    side: float = 0.0
    """Offset to the right in the picture. Calibration keeps the design value of this offset, because the offset has
    the same effect as an error of pan.
    """

    def __post_init__(self) -> None:
        """Raise ValueError if the focal length is outside the possible range, because rendering would then take
        forever.
        """
        if not MIN_FOCAL_LENGTH <= self.focal_length * self.scale <= MAX_FOCAL_LENGTH:
            raise ValueError(f"no lens has a focal length of {self.focal_length * self.scale:g} m")


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraModel:
    """Position and geometry of the camera. Position, geometry and two potentiometer readings together determine the
    view of the camera.

    The model has the parameters that the researchers at Stanford used for their cell: mount, two zero errors, roll,
    and the focal scale and offset of each lens. Unlike a 3x4 collineation matrix, these parameters stay valid for
    other aims and lenses.
    """

    mount: tuple[float, float, float]  # crossing of pan and tilt axes in W, m
    pan0: float = 0.0  # true minus potentiometer, rad, as tilt0
    tilt0: float = 0.0
    roll: float = 0.0  # of the raster about the line of sight, rad, clockwise from behind
    lenses: tuple[LensModel, ...]

    def lens(self, focal_length: float) -> LensModel:
        """Return the lens with the engraved focal length `focal_length` (m). Raises NoSuchName if there is no such
        lens.
        """
        for lens in self.lenses:
            if math.isclose(lens.focal_length, focal_length, rel_tol=1e-6):
                return lens
        known = " and ".join(f"{lens.focal_length * 1000:.0f} mm" for lens in self.lenses)
        raise BadArgument(f"the turret has no {focal_length * 1000:.0f} mm lens; it has {known}")

    def view(self, focal_length: float, pan: float, tilt: float) -> "View":
        """Return the view through the lens with the focal length `focal_length` (m). The potentiometers of the mount
        read `pan` and `tilt` (rad).
        """
        return View(model=self, lens=self.lens(focal_length), pan=pan, tilt=tilt)

    def aim(self, point_W: Array | tuple[float, float, float], focal_length: float) -> tuple[float, float]:
        """Return the potentiometer readings (pan and tilt, in rad) that bring a point in W (in metres, shape (3,))
        to the centre of the picture.
        """
        pan, tilt = 0.0, 0.0
        for _ in range(6):  # the offset of the lens from the axes makes the solution slightly implicit
            X_WC = self.view(focal_length, pan, tilt).X_WC
            right, back, drop = np.asarray(point_W) - X_WC[:3, 3]
            pan = math.atan2(right, -back) - self.pan0
            tilt = math.atan2(-drop, math.hypot(right, back)) - self.tilt0
        return pan, tilt


@dataclass(frozen=True, kw_only=True)
class View:
    """The view of the camera at one setting. The view projects points of the world into the picture, and points of the
    picture back into the world.
    """

    model: CameraModel
    lens: LensModel
    pan: float  # potentiometer reading, rad, as tilt
    tilt: float

    @cached_property
    def focal(self) -> Array:
        """Focal length in units of columns and of rows, shape (2,)."""
        f = self.lens.focal_length * self.lens.scale
        return np.array([f * COLUMNS / RASTER[0], f * ROWS / RASTER[1]])

    @cached_property
    def X_WC(self) -> Pose:
        """Pose of the camera frame; its origin is the centre of projection."""
        pan, tilt, roll = self.pan + self.model.pan0, self.tilt + self.model.tilt0, self.model.roll
        forward = np.array([math.sin(pan) * math.cos(tilt), -math.cos(pan) * math.cos(tilt), -math.sin(tilt)])
        level = np.array([-math.cos(pan), -math.sin(pan), 0.0])
        down = np.array([-math.sin(tilt) * math.sin(pan), math.sin(tilt) * math.cos(pan), -math.cos(tilt)])
        c, s = math.cos(roll), math.sin(roll)
        right, down = c * level + s * down, c * down - s * level
        lens = self.lens
        centre = np.asarray(self.model.mount) + lens.forward * forward + lens.side * right - lens.up * down
        return pose(np.column_stack([right, down, forward]), centre)

    def project(self, points_W: Array) -> Array:
        """Project points in W (in metres, shape (n, 3)) to picture points (u, v), shape (n, 2). The points must be
        in front of the camera.
        """
        X_WC, focal = self.X_WC, self.focal
        p = (np.atleast_2d(points_W) - X_WC[:3, 3]) @ X_WC[:3, :3]
        return np.asarray(p[:, :2] / p[:, 2:] * focal + CENTRE)

    def back_project(self, uv: Array, z: float) -> Array:
        """Return the points in W (in metres, shape (n, 3)) that are at the height `z` (m) and appear at the
        picture points `uv`, shape (n, 2).
        """
        X_WC = self.X_WC
        rays = self.rays(uv)
        return np.asarray(X_WC[:3, 3] + rays * ((z - X_WC[2, 3]) / rays[:, 2:]))

    def rays(self, uv: Array) -> Array:
        """Return the directions in W, shape (n, 3), of the rays through picture points (u, v), shape (n, 2). The
        component of each direction along the optical axis is 1.
        """
        slopes = (np.atleast_2d(uv) - CENTRE) / self.focal
        in_camera = np.ones((len(slopes), 3))
        in_camera[:, :2] = slopes
        return np.asarray(in_camera @ self.X_WC[:3, :3].T)

    def resolution(self, point_W: Array) -> tuple[float, float]:
        """Return two resolutions of a horizontal plane through `point_W`, in picture points per metre. The first is
        along the picture lines, and the second across them.
        """
        uv = self.project(point_W) + np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
        around = self.back_project(uv, float(np.ravel(point_W)[2]))
        across, down = np.linalg.norm(around[1:] - around[0], axis=1)
        return 1 / float(across), 1 / float(down)
