"""Fine photographs: the mean of many exposures, each through another point of the lens, of the lamp and of the sky.

OpenGL draws hard shadows, sharp all over, with edges in steps. The mean, taken of light and not of the values of the
screen, has soft shadows, what is out of focus blurred, and smooth edges.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Final

import mujoco
import numpy as np

from handeye.cell.film_stock import FILMS, GAMMA
from handeye.cell.gloss import polish
from handeye.cell.lens import Lens
from handeye.cell.photograph import Near, Photograph, Photographer, check_size, smooth_photograph
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.pose import Array

USUAL: Final = 24
MOST: Final = 1000
_SHADOW: Final = 2048
"""Points along a side of the map of shadows: their edges are averaged."""
_TURN: Final = np.pi * (3 - np.sqrt(5))
"""Golden angle: from one point of a spiral to the next."""
_SEED: Final = 1
_LIGHT: Final = ((np.arange(256) / 255) ** GAMMA).astype(np.float32)
"""Light of a point of the screen by its value."""
_PLASTIC: Final = np.array([0.7548776662466927, 0.5698402909980532])
"""Steps of an even sequence in a square, from the root of x^3 = x + 1."""
Told = Callable[[int, int], None]
"""Is called with the number of each exposure before it is made, from 1 on, and with how many there are."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Exposing:
    """How a fine photograph is made."""

    exposures: int = USUAL
    film: str = "colour"

    def __post_init__(self) -> None:
        """Raises InvalidInput if there is no such film, or so many exposures cannot be."""
        if self.film not in FILMS:
            raise NoSuchName(f"there is no film {quoted(self.film)}; there are {', '.join(FILMS)}")
        whole = isinstance(self.exposures, (int, np.integer))
        if not whole or not 1 <= self.exposures <= MOST:
            raise BadArgument(f"{self.exposures} exposures cannot be made; there are 1 to {MOST}")


def exposing(*, fine: bool, film: str | None, exposures: int | None) -> Exposing | None:
    """How a photograph is made by what was asked for; None: plainly. Film and exposures are of fine ones only.

    Raises:
        InvalidInput: as `Exposing`.
    """
    if not (fine or film is not None or exposures is not None):
        return None
    return Exposing(
        film="colour" if film is None else str(film), exposures=USUAL if exposures is None else exposures
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Exposure:
    """What one exposure is seen from and lit from, points of unit discs, and its shift, in points; shape (2,) each."""

    lens: Array
    lamp: Array
    sky: Array
    shift: Array


def photographed(
    model: mujoco.MjModel, data: mujoco.MjData, *, camera: str, width: int, height: int, how: Exposing | None,
    told: Told = lambda number, of: None,
) -> Photograph:  # fmt: skip
    """A photograph by a camera of the scene: a fine one, or a plain one.

    Raises:
        InvalidInput: no such camera, the size cannot be, or no OpenGL on this machine.
    """
    if how is None:
        return smooth_photograph(model, data, camera=camera, width=width, height=height)
    return fine_photograph(model, data, view=camera, width=width, height=height, how=how, told=told)


def fine_photograph(
    model: mujoco.MjModel, data: mujoco.MjData, *, view: str | Near, width: int, height: int, how: Exposing,
    told: Told = lambda number, of: None,
) -> Photograph:  # fmt: skip
    """A photograph of many exposures.

    Args:
        view: a camera of the scene, or from nearby.

    Raises:
        InvalidInput: no such camera, the size cannot be, or no OpenGL on this machine.
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
        stock.lighting.throw(scene, model, exposure.lamp, exposure.sky)
        light += _LIGHT[photographer.exposed()]
    return stock.develop(light.astype(float) / how.exposures)


def _exposures(number: int) -> Iterator[_Exposure]:
    """So many exposures, always the same, spread evenly over lens, lamp, sky and point, and each in another order."""
    disc, order = _spiral(number), np.random.default_rng(_SEED)
    lamps, skies = disc[order.permutation(number)], disc[order.permutation(number)]
    for k, (lens, lamp, sky) in enumerate(zip(disc, lamps, skies, strict=True)):
        yield _Exposure(lens=lens, lamp=lamp, sky=sky, shift=k * _PLASTIC % 1 - 0.5)


def _spiral(number: int) -> Array:
    """Points spread evenly over the unit disc, shape (n, 2)."""
    k = np.arange(number)
    radius, angle = np.sqrt((k + 0.5) / number), _TURN * k
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
