"""Takes fine photographs. A fine photograph is the mean of many exposures. Each exposure uses different points of the
lens, the lamp and the sky.

A plain OpenGL picture has hard shadows and jagged edges, and everything in it is in focus. The exposures are averaged
as light, not as screen values. The mean picture has soft shadows and smooth edges, and objects out of focus are
blurred.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Final, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.film_stock import FILMS, GAMMA
from handeye.cell.photograph import Near, Photograph, Photographer, check_size, smooth_photograph
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.pose import Array

_TOLD: Final = "gloss/"
"""A numeric field of the scene with this prefix holds the metalness and roughness of a material."""


def polish(scene: mujoco.MjvScene, model: mujoco.MjModel) -> None:
    """Give the shapes in a prepared scene the gloss of their materials in `model`."""
    told = _told(model)
    for shape in scene.geoms[: scene.ngeom]:
        if shape.matid in told:
            metallic, roughness = told[shape.matid]
            shape.specular = 0.1 + 0.8 * metallic * (1 - 0.3 * roughness)
            shape.shininess = 0.7 * (1 - roughness)


def _told(model: mujoco.MjModel) -> dict[int, tuple[float, float]]:
    """Return the metalness and roughness of each material. The keys are the numbers of the materials."""
    figures = {
        model.numeric(number).name: tuple(model.numeric(number).data.tolist())
        for number in range(model.nnumeric)
    }
    return {
        number: figures[name]
        for number in range(model.nmat)
        if (name := _TOLD + model.material(number).name) in figures
    }


APERTURE: Final = 0.008  # radius of the opening, in m: of a 50 mm lens at f/3.1
_NEAR, _FAR = 0.1, 14.0  # clipping planes, in m
_MIDDLE: Final = 20  # the focus is measured in the middle of the picture, 1/20 of its sides to either side


@dataclass(frozen=True, slots=True, kw_only=True)
class Lens:
    """A lens at a place, pointing in a direction, with the picture upright."""

    eye: Array  # its middle in W, m
    forward: Array
    up: Array
    slopes: tuple[float, float]  # half the width and half the height of what it sees, over the distance
    size: tuple[int, int]  # points of the picture, width and height
    focus: float = 1.0  # distance at which the picture is sharp, in m

    @classmethod
    def of(cls, scene: mujoco.MjvScene, size: tuple[int, int]) -> Self:
        """Return the lens of the camera for which a scene was prepared."""
        left, right = scene.camera  # MuJoCo makes two, one on each side of the camera
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
        """Look through one point of the lens. `at`, shape (2,), says how far this point lies to the right of the
        centre of the lens, and how far above it, in radii of the lens. The focus stays unchanged, and the picture is
        shifted by `shift` (points, shape (2,)).
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
        """Return the distance (m) of the object in the centre of a picture, computed from its depth buffer."""
        rows, columns = (
            slice(side // 2 - side // _MIDDLE, side // 2 + side // _MIDDLE + 1) for side in depth.shape
        )
        return float(_NEAR * _FAR / (_FAR - np.median(depth[rows, columns]) * (_FAR - _NEAR)))


USUAL: Final = 48
MOST: Final = 1000
_SHADOW: Final = 2048  # points along a side of the map of shadows: their edges are averaged
_TURN: Final = np.pi * (3 - np.sqrt(5))  # golden angle: from one point of a spiral to the next
_SEED: Final = 1
_LIGHT: Final = ((np.arange(256) / 255) ** GAMMA).astype(np.float32)
"""Amount of light for each of the 256 values of a pixel."""
_PLASTIC: Final = np.array([0.7548776662466927, 0.5698402909980532])
"""Steps of a sequence that fills a square evenly. They are computed from the root of x^3 = x + 1."""
Progress = Callable[[int, int], None]
"""Function called before each exposure. It receives the number of this exposure (the first is 1) and the number of all
exposures.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExposurePlan:
    """Settings of a fine photograph."""

    exposures: int = USUAL
    film: str = "colour"

    def __post_init__(self) -> None:
        """Raise InvalidInput if the film is unknown or the number of exposures is out of range."""
        if self.film not in FILMS:
            raise NoSuchName(f"there is no film {quoted(self.film)}; the films are {', '.join(FILMS)}")
        whole = isinstance(self.exposures, (int, np.integer))
        if not whole or not 1 <= self.exposures <= MOST:
            raise BadArgument(f"{self.exposures} exposures are not possible; choose 1 to {MOST}")


def exposing(*, fine: bool, film: str | None, exposures: int | None) -> ExposurePlan | None:
    """Return the requested settings, or None for a plain photograph. Raises InvalidInput as `ExposurePlan` does."""
    if not (fine or film is not None or exposures is not None):
        return None
    return ExposurePlan(
        film="colour" if film is None else str(film), exposures=USUAL if exposures is None else exposures
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Exposure:
    """Points on the unit discs of lens, lamp and sky for one exposure, and the shift of the picture in pixels. Each
    has shape (2,).
    """

    lens: Array
    lamp: Array
    sky: Array
    shift: Array


def photographed(
    model: mujoco.MjModel, data: mujoco.MjData, *, camera: str, width: int, height: int, how: ExposurePlan | None,
    told: Progress = lambda number, of: None,
) -> Photograph:  # fmt: skip
    """Take a photograph with one of the scene's cameras: a plain photograph if `how` is None, and a fine one if not.
    Raises InvalidInput as `fine_photograph` does.
    """
    if how is None:
        return smooth_photograph(model, data, camera=camera, width=width, height=height)
    return fine_photograph(model, data, view=camera, width=width, height=height, how=how, told=told)


def fine_photograph(
    model: mujoco.MjModel, data: mujoco.MjData, *, view: str | Near, width: int, height: int, how: ExposurePlan,
    told: Progress = lambda number, of: None,
) -> Photograph:  # fmt: skip
    """Take a photograph that is the mean of many exposures. Raises InvalidInput if the camera or OpenGL is missing, or
    if the size is impossible.
    """
    check_size(width, height)
    stock = FILMS[how.film]
    photographer = Photographer(model, width=width, height=height, shadow=_SHADOW, samples=0)
    scene = photographer.aimed(model, data, view)
    polish(scene, model)
    lens = Lens.of(scene, (width, height))
    centre = np.zeros(2)
    lens.aim(scene, centre, centre)
    lens = replace(lens, focus=Lens.looked_at(photographer.depth()))
    light = np.zeros((height, width, 3), dtype=np.float32)
    for number, exposure in enumerate(_exposures(how.exposures), 1):
        told(number, how.exposures)
        lens.aim(scene, exposure.lens, exposure.shift)
        stock.lighting.throw(scene, model, exposure.lamp, exposure.sky, exposure.shift)
        light += _LIGHT[photographer.exposed()]
    return stock.develop(light.astype(float) / how.exposures)


def _exposures(number: int) -> Iterator[_Exposure]:
    """Yield exposures, always the same ones, spread evenly over the lens, the lamp, the sky and the pixel. Lens, lamp,
    sky and pixel each have their own order of points.
    """
    k, order = np.arange(number), np.random.default_rng(_SEED)
    radius, angle = np.sqrt((k + 0.5) / number), _TURN * k
    disc = np.column_stack(
        [radius * np.cos(angle), radius * np.sin(angle)]
    )  # spread evenly over the unit disc
    lamps, skies = disc[order.permutation(number)], disc[order.permutation(number)]
    for at, (lens, lamp, sky) in enumerate(zip(disc, lamps, skies, strict=True)):
        yield _Exposure(lens=lens, lamp=lamp, sky=sky, shift=at * _PLASTIC % 1 - 0.5)
