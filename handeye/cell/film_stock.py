"""Films: each is used with its own lighting, and converts light to a picture in its own way."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.cell.lighting import Lighting
from handeye.core.pose import Array

GAMMA: Final = 2.2  # light is the value of a point of the screen to this power
_SEED: Final = 1973
_LINES: Final = 960  # height (points) of a picture whose grain is a point wide
_VIGNETTE: Final = 0.11  # how much less light falls into the corners


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmStock:
    """A film, and the lighting used with it."""

    lighting: Lighting
    developed: Callable[[Array], Array]
    """Converts light to screen values from 0 to 1; both have shape (height, width, 3)."""

    def develop(self, light: Array) -> NDArray[np.uint8]:
        """Make the photograph from the light on each point, shape (height, width, 3). White has the value 1."""
        y, x = (np.linspace(-1, 1, side) for side in light.shape[:2])
        values = self.developed(light * (1 - _VIGNETTE * np.add.outer(y**2, x**2))[..., None])
        return np.asarray(np.rint(255 * np.clip(values, 0, 1)), dtype=np.uint8)


def _contrast(values: Array, share: float) -> Array:
    """Raise the contrast: dark values become darker and light values lighter. `share` is the fraction, from 0 to 1,
    of the greatest effect.
    """
    return np.asarray((1 - share) * values + share * values**2 * (3 - 2 * values))


def _on_screen(light: Array, gain: float) -> Array:
    """Convert light to screen values. Strong light is compressed, not cut off."""
    bright = gain * light
    return np.asarray(np.clip(1.28 * bright * (1 + bright / 9) / (1 + bright), 0, 1) ** (1 / GAMMA))


def _black_and_white(light: Array) -> Array:
    """Print on hard paper: shadows are deep, and white has the slight tint of the paper."""
    grey = _contrast(_on_screen(light @ _PANCHROMATIC, 4.5), 0.6)
    tone = 0.06 + 0.90 * grey + _grain(*grey.shape)
    return np.asarray(tone[..., None] * _PAPER)


_PANCHROMATIC: Final = np.array([0.30, 0.55, 0.15])
"""Sensitivity of a black-and-white film to red, green and blue."""
_PAPER: Final = np.array([1.0, 0.985, 0.945])
_GRAIN: Final = 0.016  # standard deviation of the grain


def _grain(height: int, width: int) -> Array:
    """Make the grain of the film, which is always the same for pictures of the same size."""
    noise = np.random.default_rng(_SEED).standard_normal((height, width))
    soft = cv2.GaussianBlur(noise, (0, 0), max(0.3, 0.8 * height / _LINES))
    return np.asarray(_GRAIN * soft / soft.std())


FILMS: Final[Mapping[str, FilmStock]] = {
    "colour": FilmStock(
        lighting=Lighting(
            lamp=(0.68, 0.635, 0.56), gloss=0.5, sky=(0.34, 0.37, 0.42), everywhere=(0.17, 0.175, 0.185),
            radius=0.06,
        ),
        developed=lambda light: _contrast(_on_screen(light, 3.1), 0.35),
    ),
    "1973": FilmStock(
        lighting=Lighting(
            lamp=(0.90, 0.88, 0.85), gloss=0.9, sky=(0.30, 0.30, 0.30), everywhere=(0.15, 0.15, 0.15),
            stand=(-0.7, 0.55, 0.75), radius=0.06,
        ),
        developed=_black_and_white,
    ),
}  # fmt: skip
"""Films by name."""
PLAIN: Final = Lighting(
    lamp=(0.68, 0.635, 0.56), gloss=0.5, sky=(0.22, 0.24, 0.27), everywhere=(0.22, 0.225, 0.235), radius=0.0
)
"""Lighting of a photograph of one exposure. In such a photograph, the light of the sky casts no shadows, so this light
is weaker than in a photograph of many exposures.
"""
TONES: Final = np.rint(
    255 * np.clip(FILMS["colour"].developed((np.arange(256) / 255) ** GAMMA), 0, 1)
).astype(np.uint8)
"""For each of the 256 values that a point of the screen can have: the value of this point on colour film."""
