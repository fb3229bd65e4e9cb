"""Films: each is used with its own lighting, and converts light to a picture in its own way."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

Colour = tuple[float, float, float]
_AWAY: Final = 2.0  # distance of the sky from the middle of the scene, divided by the size of the scene
_GRAZING: Final = 0.2  # least height of a point of the sky, divided by its distance


@dataclass(frozen=True, slots=True, kw_only=True)
class Lighting:
    """The lighting of a photograph: a lamp in the form of a disc, and a sky."""

    lamp: Colour
    gloss: float  # share of the lamp that shiny shapes mirror
    sky: Colour
    everywhere: Colour  # light that throws no shadow
    stand: tuple[float, float, float]  # place of the lamp from the middle of the scene, in sizes of the scene
    radius: float  # radius of the lamp's disc, in m
    cutoff: float = 48.0  # half of the angle of the lamp's cone, degrees

    def throw(self, scene: mujoco.MjvScene, model: mujoco.MjModel, lamp: Array, sky: Array) -> None:
        """Light a scene from one point of the lamp and one point of the sky, each of shape (2,). The point of the lamp
        is given in radii of the lamp's disc. The point of the sky is given by the x and y of the unit vector towards
        it.
        """
        middle = np.array(model.stat.center)
        scene.nlight = 2
        self._lamp(scene.lights[0], middle, model.stat.extent, lamp)
        self._sky(scene.lights[1], middle, model.stat.extent, sky)

    def _lamp(self, light: mujoco.MjvLight, middle: Array, extent: float, at: Array) -> None:
        stand = middle + extent * np.array(self.stand)
        axis = _unit(middle - stand)
        right = _unit(np.cross(axis, (0.0, 0.0, 1.0)))
        place = stand + self.radius * (at[0] * right + at[1] * np.cross(right, axis))
        light.type, light.cutoff, light.exponent = mujoco.mjtLightType.mjLIGHT_SPOT, self.cutoff, 1.0
        light.diffuse[:], light.ambient[:] = self.lamp, self.everywhere
        light.specular[:] = self.gloss * np.array(self.lamp)
        _place(light, 0, place, middle - place)

    def _sky(self, light: mujoco.MjvLight, middle: Array, extent: float, at: Array) -> None:
        high = math.sqrt(max(_GRAZING**2, 1.0 - float(at @ at)))
        towards = _unit(np.array([*at, high]))
        light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        light.diffuse[:], light.ambient[:] = self.sky, 0.0
        light.specular[:] = self.gloss * np.array(self.sky)
        _place(light, 1, middle + _AWAY * extent * towards, -towards)


def _place(light: mujoco.MjvLight, number: int, place: Array, way: Array) -> None:
    light.id, light.texid, light.headlight, light.castshadow = number, -1, 0, 1
    light.pos[:], light.dir[:], light.attenuation[:] = place, _unit(way), (1.0, 0.0, 0.0)


def _unit(vector: Array) -> Array:
    return np.asarray(vector / np.linalg.norm(vector))


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
        """Make the photograph from light of shape (height, width, 3), in which 1 is white."""
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
            lamp=(0.76, 0.69, 0.59), gloss=0.55, sky=(0.44, 0.47, 0.52), everywhere=(0.29, 0.295, 0.31),
            stand=(0.9, -0.95, 0.9), radius=0.12,
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
