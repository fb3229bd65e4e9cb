"""The raster of a television tube: where on its target the beam reads the points of a picture.

Coils and their currents are not perfect. The raster is drawn out or in towards the corners, uneven along its lines and
from line to line, and no picture lies quite where the one before lay. All figures are shares of half the picture.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.ports.camera import COLUMNS, ROWS
from handeye.pose import Array

MIDDLE: Final = np.array([(COLUMNS - 1) / 2, (ROWS - 1) / 2])
HALF: Final = np.array([COLUMNS / 2, ROWS / 2])


@dataclass(frozen=True, slots=True, kw_only=True)
class Raster:
    """Shape of a raster."""

    pincushion: float = 0.0
    """How far a corner is drawn inwards in the picture, over its distance from the middle."""
    lines: float = 0.0
    """How far the middle of each line is off, over half its length, where its ends are right."""
    field: float = 0.0
    """The same down the picture."""

    def read(self, light: NDArray[np.float32], shift: Array) -> NDArray[np.float32]:
        """The light that the beam meets, shape (256, 333), in a picture that lies `shift` = (columns, rows) off."""
        import cv2  # not for plans, which know the pump's worlds

        v, u = np.mgrid[0:ROWS, 0:COLUMNS]
        at = self.target(np.stack([u - shift[0], v - shift[1]], axis=-1)).astype(np.float32)
        return np.asarray(
            cv2.remap(light, at[..., 0], at[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE),
            dtype=np.float32,
        )

    def target(self, uv: Array) -> Array:
        """Places on the target, in points of an even raster, that are read at points `uv`, shape (..., 2)."""
        p = (uv - MIDDLE) / HALF
        stretch = 1 + self.pincushion * (p**2).sum(axis=-1, keepdims=True) / 2
        return np.asarray(MIDDLE + HALF * (p * stretch + (self.lines, self.field) * (1 - p**2)))

    def shown(self, uv: Array) -> Array:
        """Points at which places on the target are read, shape (..., 2): the inverse of `target`."""
        found = uv
        for _ in range(
            8
        ):  # distortions are small and smooth: each step is wrong by a fiftieth of the one before
            found = found + uv - self.target(found)
        return np.asarray(found)
