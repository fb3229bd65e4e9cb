"""The lighting of photographs: a lamp in the form of a disc, and a sky. The television camera never sees this light."""

import math
from dataclasses import dataclass
from typing import Final

import mujoco
import numpy as np

from handeye.core.pose import Array

Colour = tuple[float, float, float]
LAMP: Final = "studio_lamp"
"""Name of the numeric field in which a scene states the place (W, m) of the lamp for photographs."""
CUTOFF: Final = 75.0  # half of the angle of the lamp's cone, degrees
SHADOWED: Final = 0.5
"""Angle of the inner cone, in which bodies cast shadows, as a fraction of the angle of the lamp's cone. A larger inner
cone would make the shadows coarser.
"""
SKY_SHADOWED: Final = (
    1.5  # radius of the region in which the sky casts shadows, divided by the size of the scene
)
_FALLOFF: Final = 0.6  # exponent of the lamp's falloff towards the edge of its cone
_STAND: Final = np.array([0.9, -0.95, 0.9])
"""Place of the lamp relative to the middle of the scene, as a multiple of the size of the scene. A scene can state
another place.
"""
_AWAY: Final = 2.0  # distance of the sky from the middle of the scene, divided by the size of the scene
_GRAZING: Final = 0.2  # least height of a point of the sky, divided by its distance
_WANDER: Final = 0.07
"""How far the middle of the map of shadows moves between exposures, divided by the size of the scene. The map is
coarse, so the shadows of one exposure have stepped edges. Because the map moves, the steps differ between exposures,
and the mean of all exposures has smooth edges.
"""


def lamp_place(model: mujoco.MjModel) -> Array | None:
    """Return the place (W, m) of the lamp for photographs, or None if the scene does not state it."""
    for number in range(model.nnumeric):
        if (figure := model.numeric(number)).name == LAMP:
            return np.array(figure.data, dtype=float)
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Lighting:
    """The lighting of a photograph: a lamp in the form of a disc, and a sky."""

    lamp: Colour
    gloss: float  # share of the lamp that shiny shapes mirror
    sky: Colour
    everywhere: Colour  # light that throws no shadow
    radius: float  # radius of the lamp's disc, in m
    stand: Colour | None = None
    """Position of the lamp relative to the middle of the scene, divided by the size of the scene. None: the position
    that the scene gives.
    """

    def throw(
        self, scene: mujoco.MjvScene, model: mujoco.MjModel, lamp: Array, sky: Array, wander: Array
    ) -> None:
        """Light a scene from one point of the lamp and one point of the sky. The point of the lamp is given in radii
        of the lamp's disc. The point of the sky is given by the horizontal components (x, y) of the unit vector
        towards it. `wander` says how far the shadow maps are moved sideways, as a fraction (-.5 to .5) of their
        greatest movement. Each argument has shape (2,).
        """
        scene.nlight = 3
        self._lamp(scene.lights[0], model, lamp, wander)
        self._sky(scene.lights[1], model, sky, wander)
        self._everywhere(scene.lights[2])

    def _lamp(self, light: mujoco.MjvLight, model: mujoco.MjModel, at: Array, wander: Array) -> None:
        middle, stand = np.array(model.stat.center), self._place(model)
        right, up = _across(middle - stand)
        place = stand + self.radius * (at[0] * right + at[1] * up)
        aim = middle + _WANDER * model.stat.extent * (wander[0] * right + wander[1] * up)
        light.type, light.cutoff, light.exponent = mujoco.mjtLightType.mjLIGHT_SPOT, CUTOFF, _FALLOFF
        light.diffuse[:], light.ambient[:] = self.lamp, 0.0
        light.specular[:] = self.gloss * np.array(self.lamp)
        _set(light, 0, place, aim - place)

    def _place(self, model: mujoco.MjModel) -> Array:
        stated = lamp_place(model) if self.stand is None else None
        stand = _STAND if self.stand is None else np.array(self.stand)
        return model.stat.center + model.stat.extent * stand if stated is None else stated

    def _sky(self, light: mujoco.MjvLight, model: mujoco.MjModel, at: Array, wander: Array) -> None:
        high = math.sqrt(max(_GRAZING**2, 1.0 - float(at @ at)))
        towards = unit(np.array([*at, high]))
        right, up = _across(-towards)
        aim = model.stat.center + _WANDER * model.stat.extent * (wander[0] * right + wander[1] * up)
        light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        light.diffuse[:], light.ambient[:] = self.sky, 0.0
        light.specular[:] = self.gloss * np.array(self.sky)
        _set(light, 1, aim + _AWAY * model.stat.extent * towards, -towards)

    def _everywhere(self, light: mujoco.MjvLight) -> None:
        light.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        light.diffuse[:], light.specular[:], light.ambient[:] = 0.0, 0.0, self.everywhere
        _set(light, 2, np.zeros(3), np.array([0.0, 0.0, -1.0]))
        light.castshadow = 0

    def throw_once(self, scene: mujoco.MjvScene, model: mujoco.MjModel) -> None:
        """Light a scene from two points: the middle of the lamp, and the middle of the sky. The light from the sky
        casts no shadows.
        """
        middle = np.zeros(2)
        self.throw(scene, model, middle, middle, middle)
        scene.lights[1].castshadow = 0


def _set(light: mujoco.MjvLight, number: int, place: Array, way: Array) -> None:
    light.id, light.texid, light.headlight, light.castshadow = number, -1, 0, 1
    light.pos[:], light.dir[:], light.attenuation[:] = place, unit(way), (1.0, 0.0, 0.0)


def _across(way: Array) -> tuple[Array, Array]:
    """Return two unit vectors at right angles to a direction and to each other. The first is horizontal."""
    axis = unit(way)
    level = np.cross(axis, (0.0, 0.0, 1.0))
    right = unit(level) if np.linalg.norm(level) > 1e-6 else np.array([1.0, 0.0, 0.0])
    return right, np.cross(right, axis)


def unit(vector: Array) -> Array:
    """Return the vector of length 1 in the direction of `vector`."""
    return np.asarray(vector / np.linalg.norm(vector))
