"""Computes the grain of wood, cast iron, belt and floor for photographs.

The television camera sees only the plain intensities of the materials, so a texture does not affect any
measurement.
"""

from collections.abc import Callable
from functools import cache
from typing import Any, Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

_SIZE: Final = 512
_BENCH: Final = 1024  # px; more than for others, because photographs show most of the bench
_BOARDS: Final = 33
_LOST: Final = 1e-9  # fraction of a frequency that changes no level
Grain = Callable[[np.random.Generator], Array]
"""Function that computes a square picture of relative intensities, shape (n, n, 3)."""


def add_textures(spec: mujoco.MjSpec) -> None:
    """Give the materials their grain. Each grain has its own random generator with a fixed seed, so the grain is
    always the same.
    """
    for name, pixels in _pixels().items():
        texture = spec.add_texture(name=name, type=mujoco.mjtTexture.mjTEXTURE_2D)
        texture.height, texture.width, texture.nchannel = pixels.shape
        texture.data = pixels.tobytes()
    for name, repeat in _REPEATS.items():
        material = spec.material(name)
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = _LIKE.get(name, name)
        material.texrepeat[:] = [repeat, repeat]
        material.texuniform = repeat != 1


@cache
def _pixels() -> dict[str, NDArray[np.uint8]]:
    """Return the texture of each grain, with the name of the grain as the key."""
    return {
        name: (255 * grain(np.random.default_rng(number)).clip(0, 1)).astype(np.uint8)
        for number, (name, grain) in enumerate(_GRAINS.items())
    }


def _smooth(rng: np.random.Generator, along_x: float, along_y: float, size: int = _SIZE) -> Array:
    """Return noise that is blurred along x and y. The blur along each axis is Gaussian, with the standard deviations
    `along_x` and `along_y` (pixels). The noise wraps around at the edges and has unit variance. Frequencies that the
    blur removes are not computed.
    """
    down, across = _passed(along_y, np.fft.fftfreq(size)), _passed(along_x, np.fft.rfftfreq(size))
    kept = np.count_nonzero(across > _LOST)
    spectrum = np.fft.rfft(rng.standard_normal((size, size)), axis=1)[:, :kept]
    spectrum = np.fft.ifft(np.fft.fft(spectrum, axis=0) * np.outer(down, across[:kept]), axis=0)
    soft = np.fft.irfft(spectrum, size, axis=1)
    return np.asarray((soft - soft.mean()) / soft.std())


def _passed(sigma: float, frequencies: NDArray[np.floating[Any]]) -> Array:
    """Return the fraction of each frequency (1/pixel) that a Gaussian blur passes."""
    return np.asarray(np.exp(-2 * (np.pi * sigma * frequencies) ** 2))


def _tinted(value: Array, tint: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Array:
    return np.asarray(value[..., None] * np.array(tint))


def _streaks(rng: np.random.Generator, size: int = _SIZE) -> Array:
    """Return wood grain along x."""
    return 0.035 * _smooth(rng, 60, 1.2, size) + 0.02 * np.sin(6 * _smooth(rng, 90, 12, size))


def _bench(rng: np.random.Generator) -> Array:
    """Return the grain of old maple: narrow boards along x, each of two pieces with different tones."""
    row = np.arange(_BENCH)
    board = row * _BOARDS // _BENCH
    tones, joints = rng.uniform(-0.08, 0.05, (_BOARDS, 2)), rng.integers(0, _BENCH, _BOARDS)
    first = row[None, :] < joints[board][:, None]
    tone = np.where(first, tones[board][:, :1], tones[board][:, 1:])
    gap = (row * _BOARDS % _BENCH < _BOARDS)[:, None] | (abs(row[None, :] - joints[board][:, None]) < 1)
    return _tinted((0.88 + tone + _streaks(rng, _BENCH)) * np.where(gap, 0.66, 1.0), (1.0, 0.84, 0.62))


def _cast(rng: np.random.Generator) -> Array:
    """Return the surface of a sand casting."""
    return _tinted(0.88 + 0.07 * _smooth(rng, 1.5, 1.5) + 0.03 * _smooth(rng, 20, 20), (1.0, 0.985, 0.96))


def _milled(rng: np.random.Generator) -> Array:
    """Return the marks of a face mill that moved along y: slightly uneven arcs."""
    x = np.arange(_SIZE) - _SIZE / 2
    arc = np.sqrt((0.8 * _SIZE) ** 2 - x**2)
    marks = np.sin(2 * np.pi * _MARKS * np.add.outer(np.arange(_SIZE), -arc) / _SIZE)
    return _tinted(0.92 + 0.022 * marks + 0.012 * _smooth(rng, 30, 1.0) + 0.012 * _smooth(rng, 25, 25))


def _woven(rng: np.random.Generator) -> Array:
    """Return the weave of a slightly worn belt."""
    x = np.arange(_SIZE)
    weave = 0.05 * np.add.outer(np.sin(2 * np.pi * x / 8), np.sin(2 * np.pi * x / 8))
    return _tinted(0.86 + weave + 0.05 * _smooth(rng, 15, 60))


def _tiles(rng: np.random.Generator) -> Array:
    """Return a picture of four linoleum tiles, two by two, in alternating tones."""
    half = _SIZE // 2
    tone = np.kron(np.array([[0.94, 0.80], [0.80, 0.94]]), np.ones((half, half)))
    joint = np.arange(_SIZE) % half < 3
    joints = np.logical_or.outer(joint, joint)
    return _tinted((tone + 0.025 * _smooth(rng, 3, 3)) * np.where(joints, 0.75, 1.0), (1.0, 0.97, 0.9))


_MARKS: Final = 64  # number of mill marks in a picture
_GRAINS: Final[dict[str, Grain]] = {
    "belt": _woven, "cast": _cast, "floor": _tiles, "machined": _milled, "table": _bench,
    "wood": lambda rng: _tinted(0.87 + _streaks(rng), (1.0, 0.95, 0.88)),
}  # fmt: skip
_LIKE: Final = {"top": "machined", "block": "machined"}  # materials that have the grain of another
_REPEATS: Final = {
    "belt": 1, "cast": 25.0, "floor": 3.3, "machined": 12.0, "table": 1, "wood": 1, "top": 12.0, "block": 12.0,
}  # fmt: skip
"""How often the texture of each material repeats per metre. The value 1 is an exception: this texture covers the whole
surface once.
"""
