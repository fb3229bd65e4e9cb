"""A lens of finite aperture: where each point of it stands, and through which frustum it sees."""

from dataclasses import dataclass
from typing import Final, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

APERTURE: Final = 0.008
"""Radius of the opening, m: of a 50 mm lens at f/3.1."""
_NEAR, _FAR = 0.1, 14.0
"""Clipping planes, m."""
_MIDDLE: Final = 20
"""What is focused on takes the middle of the picture, one part in so many of its sides to either side."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lens:
    """A lens that looks from a place, upright in the picture."""

    eye: Array
    """Its middle in W, m."""
    forward: Array
    up: Array
    slopes: tuple[float, float]
    """Half the width and half the height of what it sees, over the distance."""
    size: tuple[int, int]
    """Points of the picture, width and height."""
    focus: float = 1.0
    """Distance at which things are sharp, m."""

    @classmethod
    def of(cls, scene: mujoco.MjvScene, size: tuple[int, int]) -> Self:
        """The lens of the camera that a scene was prepared for."""
        left, right = scene.camera  # two, for two eyes; they stand beside the camera
        high = (left.frustum_top - left.frustum_bottom) / 2 / left.frustum_near
        wide = left.frustum_width / left.frustum_near or high * size[0] / size[1]
        return cls(
            eye=(left.pos + right.pos) / 2.0,
            forward=left.forward.astype(float),
            up=left.up.astype(float),
            slopes=(float(wide), float(high)),
            size=size,
        )

    def aim(self, scene: mujoco.MjvScene, at: Array, shift: Array) -> None:
        """Look through a point of the lens; what is in focus stays where it is in the picture.

        Args:
            at: the point, in radii of the aperture to the right and up; shape (2,).
            shift: how far the picture is shifted, in its points to the right and up; shape (2,).
        """
        right = np.cross(self.forward, self.up)
        aside = APERTURE * at
        across = -aside / self.focus + 2 * np.array(self.slopes) * shift / np.array(self.size)
        for camera in scene.camera:
            camera.pos[:] = self.eye + aside[0] * right + aside[1] * self.up
            camera.forward[:], camera.up[:] = self.forward, self.up
            camera.frustum_near, camera.frustum_far = _NEAR, _FAR
            camera.frustum_width = _NEAR * self.slopes[0]
            camera.frustum_center = _NEAR * across[0]
            camera.frustum_top = _NEAR * (across[1] + self.slopes[1])
            camera.frustum_bottom = _NEAR * (across[1] - self.slopes[1])

    @staticmethod
    def looked_at(depth: NDArray[np.float32]) -> float:
        """Distance (m) of what is in the middle of a picture through the middle of a lens, from its depth buffer."""
        rows, columns = (
            slice(side // 2 - side // _MIDDLE, side // 2 + side // _MIDDLE + 1) for side in depth.shape
        )
        return float(_NEAR * _FAR / (_FAR - np.median(depth[rows, columns]) * (_FAR - _NEAR)))
