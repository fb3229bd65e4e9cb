"""Model of a vidicon with a digitiser: blur, shading, gamma, gain, noise, and sixteen intensity levels."""

import math
from functools import cache
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.ports.camera import COLUMNS, RASTER, ROWS, Picture

Luminance = NDArray[np.float32]
"""Light on the target, shape (256, 333); 1 is a white surface in full light."""

BLUR: Final = (0.65, 0.45)  # sigma, points along the line and across
SHADING: Final = 0.10  # loss in the corners
GAMMA: Final = 0.7
NOISE: Final = 1.0  # sigma, levels
PEAK: Final = 12.5  # level of the bright parts
BRIGHT: Final = 97  # percentile that counts as the bright parts
"""The camera takes this percentile of the signal as the brightness of the bright parts. The values from `BLUR` to
`BRIGHT` are those of the signal chain in the vision study, section 0.1. They are placeholders that give a realistic
picture.
"""
GAIN_WINDOW: Final = 0.6
"""The target voltage is adjusted to the bright parts in the middle of the picture. This fraction of the width and of
the height counts as the middle. Placeholder.
"""

F_NUMBER: Final = 2.8  # placeholder
PITCH: Final = RASTER[0] / COLUMNS  # m
"""Width (m) of a picture point on the target, used for the blur of defocus."""


class Vidicon:
    """The tube and its digitiser. The digitiser keeps its gain (target voltage) from picture to picture."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self.gain: float | None = None  # the target voltage of the last picture; None before the first

    def expose(self, light: Luminance, *, disc: float = 0.0, hold_target: bool = False) -> Picture:
        """Digitise light. A lens that is out of focus turns each point into a disc; `disc` is the diameter of this
        disc, measured in points of the picture. If `hold_target` is True, the gain of the last picture is kept.
        """
        image = _defocused(light, disc) if disc > 0.5 else light
        image = np.asarray(cv2.GaussianBlur(image, (0, 0), sigmaX=BLUR[0], sigmaY=BLUR[1]), np.float32)
        signal = np.clip(image * _shading(), 0, None) ** GAMMA
        if self.gain is None or not hold_target:
            rows, columns = (round(n * (1 - GAIN_WINDOW) / 2) for n in signal.shape)
            bright = float(np.percentile(signal[rows:-rows, columns:-columns], BRIGHT))
            self.gain = PEAK / max(bright, 1e-3)
        noise = self._rng.normal(0.0, NOISE, signal.shape)
        return np.asarray(np.clip(np.rint(signal * self.gain + noise), 0, 15), dtype=np.uint8)


def blur_disc(focal_length: float, focused: float, distance: float) -> float:
    """Return the diameter (points) of the image of a point at `distance` when the lens is focused at `focused`.
    Both distances are in m, or infinite.
    """
    spread = 1 / distance if math.isinf(focused) else abs(focused - distance) / (distance * focused)
    lens = 1 if math.isinf(focused) else focused / (focused - focal_length)
    return focal_length**2 / F_NUMBER * spread * lens / PITCH


@cache
def _shading() -> Luminance:
    v, u = np.mgrid[-1 : 1 : ROWS * 1j, -1 : 1 : COLUMNS * 1j]
    return np.asarray(1 - SHADING * (u**2 + v**2) / 2, dtype=np.float32)


def _defocused(image: Luminance, disc: float) -> Luminance:
    """Average the image over a disc, whose border is resolved to an eighth of a point."""
    fine = 8
    n = 2 * math.ceil(disc / 2) + 3
    y, x = (np.mgrid[0 : n * fine, 0 : n * fine] + 0.5) / fine - n / 2
    kernel = (np.hypot(x, y) <= disc / 2).reshape(n, fine, n, fine).mean(axis=(1, 3))
    return cv2.filter2D(image, -1, kernel / kernel.sum(), borderType=cv2.BORDER_REPLICATE).astype(np.float32)
