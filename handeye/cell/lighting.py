"""Light by which people photograph a scene: a lamp from one side, and a sky; never the light of the drawn world."""

import math
from dataclasses import dataclass
from typing import Final

import mujoco
import numpy as np

from handeye.core.pose import Array

Colour = tuple[float, float, float]
_AWAY: Final = 2.0
"""Distance of the sky from the middle of the scene, over its size."""
_GRAZING: Final = 0.2
"""Least height of a point of the sky, over its distance."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Lighting:
    """A lamp with a disc, and a sky."""

    lamp: Colour
    gloss: float
    """Of what shines, how much of the lamp it mirrors."""
    sky: Colour
    everywhere: Colour
    """Light that throws no shadow."""
    stand: tuple[float, float, float]
    """Where the lamp stands, from the middle of the scene over its size."""
    radius: float
    """Of the lamp's disc, m."""
    cutoff: float = 48.0
    """Half of the angle of the lamp's cone, degrees."""

    def throw(self, scene: mujoco.MjvScene, model: mujoco.MjModel, lamp: Array, sky: Array) -> None:
        """Light a scene from a point of the lamp's disc, and from a point of the sky.

        Args:
            lamp: in radii of the disc to the right and up; shape (2,).
            sky: the point of the unit disc below which it stands on a half sphere; shape (2,).
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
