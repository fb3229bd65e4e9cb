"""The raster of a television tube: the positions on its target at which the beam reads the points of a picture.

Deflection coils and their currents are imperfect. The raster is pulled out or in at the corners, and is uneven
along its lines and from line to line. No picture lies exactly where the previous picture did. All numbers are
fractions of half the picture.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array
from handeye.ports.camera import COLUMNS, ROWS

MIDDLE: Final = np.array([(COLUMNS - 1) / 2, (ROWS - 1) / 2])
HALF: Final = np.array([COLUMNS / 2, ROWS / 2])


@dataclass(frozen=True, slots=True, kw_only=True)
class Raster:
    """Shape of a raster."""

    pincushion: float = 0.0
    """Inward displacement of a corner of the picture, divided by the distance of this corner from the centre."""
    lines: float = 0.0
    """Bow of each line: the displacement of its middle relative to its ends, divided by half the length of the line.
    """
    field: float = 0.0  # downward displacement of the middle line, divided by half the height of the picture

    def read(self, light: NDArray[np.float32], shift: Array) -> NDArray[np.float32]:
        """Return the light that the beam reads, shape (256, 333), in a picture that is shifted by `shift` =
        (columns, rows).
        """
        import cv2  # imported here, because planning loads this module and does not need OpenCV

        u, v = np.meshgrid(np.arange(COLUMNS) - shift[0], np.arange(ROWS) - shift[1], sparse=True)
        x, y = self._target(u, v)
        return np.asarray(
            cv2.remap(
                light,
                x.astype(np.float32),
                y.astype(np.float32),
                cv2.INTER_LINEAR,
                borderMode=cv2.BORDER_REPLICATE,
            ),
            dtype=np.float32,
        )

    def target(self, uv: Array) -> Array:
        """Return the positions on the target that are read at picture points `uv`. The positions are in points of an
        ideal raster; both arrays have shape (..., 2).
        """
        return np.stack(self._target(uv[..., 0], uv[..., 1]), axis=-1)

    def _target(self, u: Array, v: Array) -> tuple[Array, Array]:
        """Compute `target` for separate columns and rows, whose shapes must broadcast."""
        (p, q), (across, down) = ((u - MIDDLE[0]) / HALF[0], (v - MIDDLE[1]) / HALF[1]), HALF
        stretch = 1 + self.pincushion / 2 * (p**2 + q**2)
        x = MIDDLE[0] + across * (p * stretch + self.lines * (1 - p**2))
        y = MIDDLE[1] + down * (q * stretch + self.field * (1 - q**2))
        return x, y

    def shown(self, uv: Array) -> Array:
        """Return the picture points at which positions on the target are read, shape (..., 2). The inverse of
        `target`.
        """
        found = uv
        for _ in range(
            8
        ):  # distortions are small and smooth: each step is wrong by a fiftieth of the previous one
            found = found + uv - self.target(found)
        return np.asarray(found)
