"""Worlds of the bench of blocks: how far off a person teaches, a machine goes, and blocks lie, drawn from a seed."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.random_streams import random_numbers
from handeye.core.units import DEGREE, MILLIMETRE

TAUGHT: Final = 0.3 * MILLIMETRE
"""Sigma of a place that somebody drives an axis to with the teach box. Chosen."""
STACKED: Final = 0.3 * MILLIMETRE
"""Sigma of where somebody puts a stack, along X and along Y. Chosen: against a mark."""
ALIGNED: Final = 0.1 * MILLIMETRE
"""Sigma of where a block lies in its stack, along X and along Y. Chosen."""
TURNED: Final = 0.2 * DEGREE
"""Sigma of how a block is turned in its stack: as much as ALIGNED over its length."""
FRICTION: Final = (0.3, 0.5)
"""Least and greatest friction of blocks and platter; .4 in the world without errors. Chosen: dry aluminium."""
SCALES: Final = (*3 * (0.05 * MILLIMETRE,), *3 * (2e-4,))
"""m and rad: sigma of the amplitude by which a potentiometer bends over its travel. Chosen."""
_WAVE: Final = (*3 * (0.1,), *3 * (1.0,))
"""m and rad over which it does so once."""
_MOST: Final = 2.0
"""Sigmas: nobody leaves what is farther off."""


@dataclass(frozen=True, slots=True)
class BlocksWorld:
    """A world; without a seed, the one without errors. Each number has a stream of its own, by its name."""

    seed: int | None = None

    def normal(self, name: str, sigma: float) -> float:
        """A normal number of a name, clipped at two sigma."""
        if self.seed is None:
            return 0.0
        drawn = float(random_numbers(self.seed, f"blocks.{name}").standard_normal())
        return sigma * min(max(drawn, -_MOST), _MOST)

    def slip(self, number: int) -> float:
        """How far off (m) an axis is that somebody has driven with the teach box, by its number from 0."""
        return self.normal(f"taught.{number}", TAUGHT)

    @property
    def friction(self) -> float:
        """Of blocks and platter."""
        if self.seed is None:
            return sum(FRICTION) / 2
        return float(random_numbers(self.seed, "blocks.friction").uniform(*FRICTION))

    @property
    def bending(self) -> Callable[[Array], Array]:
        """How far (m, rad) six axes are from where their potentiometers tell them to be, by what these tell."""
        if self.seed is None:
            return np.zeros_like
        axes = range(len(SCALES))
        amplitudes = np.array([self.normal(f"scale.{axis}", SCALES[axis]) for axis in axes])
        phases = np.array([self.normal(f"scale.{axis}.phase", np.pi) for axis in axes])
        turns = 2 * np.pi / np.array(_WAVE)
        return lambda q: np.asarray(amplitudes * np.sin(turns * q + phases))
