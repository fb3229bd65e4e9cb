"""Grain of wood, cast iron, belt and floor, made by arithmetic: for people's pictures.

The television camera sees the materials' plain intensities, so a texture changes nothing that is measured.
"""

from collections.abc import Callable
from functools import cache
from typing import Final

import mujoco
import numpy as np

from handeye.pose import Array

_SIZE: Final = 512
Grain = Callable[[np.random.Generator], Array]
"""Draws a picture of relative intensities, shape (512, 512, 3)."""


def add_textures(spec: mujoco.MjSpec) -> None:
    """Give the materials their grain. Each is drawn from a generator of its own, always the same."""
    for name, repeat in _REPEATS.items():
        texture = spec.add_texture(name=name, type=mujoco.mjtTexture.mjTEXTURE_2D)
        texture.width, texture.height, texture.nchannel = _SIZE, _SIZE, 3
        texture.data = _pixels(name)
        material = spec.material(name)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
        material.texrepeat[:] = [repeat, repeat]
        material.texuniform = repeat != 1


@cache
def _pixels(name: str) -> bytes:
    rng = np.random.default_rng(sorted(_REPEATS).index(name))
    return np.clip(_GRAINS[name](rng) * 255, 0, 255).astype(np.uint8).tobytes()


def _smooth(rng: np.random.Generator, along_x: float, along_y: float) -> Array:
    """Noise blurred around the edges by Gaussians of these sigmas (px), of unit variance."""
    noise, frequency = rng.standard_normal((_SIZE, _SIZE)), np.fft.fftfreq(_SIZE)
    window = np.exp(-2 * np.pi**2 * np.add.outer((along_y * frequency) ** 2, (along_x * frequency) ** 2))
    soft = np.asarray(np.fft.ifft2(np.fft.fft2(noise) * window).real, np.float64)
    return np.asarray((soft - soft.mean()) / soft.std())


def _tinted(value: Array, tint: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Array:
    return np.asarray(value[..., None] * np.array(tint))


def _wood(rng: np.random.Generator, boards: int, tint: tuple[float, float, float]) -> Array:
    """Boards side by side along x, each with its own tone and grain."""
    row = np.arange(_SIZE)
    tone = rng.uniform(-0.07, 0.04, boards)[row * boards // _SIZE][:, None]
    streaks = 0.035 * _smooth(rng, 60, 1.2) + 0.02 * np.sin(6 * _smooth(rng, 90, 12))
    gap = np.where(row * boards % _SIZE < boards, 0.6, 1.0)[:, None]
    return _tinted((0.87 + tone + streaks) * gap, tint)


def _bench(rng: np.random.Generator) -> Array:
    """Old maple."""
    return _wood(rng, 11, (1.0, 0.84, 0.62))


def _timber(rng: np.random.Generator) -> Array:
    return _wood(rng, 1, (1.0, 0.95, 0.88))


def _cast(rng: np.random.Generator) -> Array:
    """Sand-cast skin."""
    return _tinted(0.88 + 0.07 * _smooth(rng, 1.5, 1.5) + 0.03 * _smooth(rng, 20, 20), (1.0, 0.985, 0.96))


def _milled(rng: np.random.Generator) -> Array:
    """Marks of a milling cutter."""
    return _tinted(0.94 + 0.02 * _smooth(rng, 40, 0.8), (1.0, 1.0, 0.99))


def _woven(rng: np.random.Generator) -> Array:
    """A belt's weave, a little worn."""
    x = np.arange(_SIZE)
    weave = 0.05 * np.add.outer(np.sin(2 * np.pi * x / 8), np.sin(2 * np.pi * x / 8))
    return _tinted(0.86 + weave + 0.05 * _smooth(rng, 15, 60))


def _tiles(rng: np.random.Generator) -> Array:
    """Linoleum tiles, two by two to a picture, in alternating tones."""
    half = _SIZE // 2
    tone = np.kron(np.array([[0.94, 0.80], [0.80, 0.94]]), np.ones((half, half)))
    joint = np.arange(_SIZE) % half < 3
    joints = np.logical_or.outer(joint, joint)
    return _tinted((tone + 0.025 * _smooth(rng, 3, 3)) * np.where(joints, 0.75, 1.0), (1.0, 0.97, 0.9))


_GRAINS: Final[dict[str, Grain]] = {
    "table": _bench, "wood": _timber, "cast": _cast, "machined": _milled, "belt": _woven, "floor": _tiles,
}  # fmt: skip
_REPEATS: Final = {
    "table": 1, "wood": 1, "cast": 25.0, "machined": 12.0, "belt": 1, "floor": 3.3,
}  # fmt: skip
"""How often a grain repeats: in a metre, or once over the whole thing."""
