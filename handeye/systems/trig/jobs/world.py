"""Worlds of the block bench: errors of teaching, machine and block poses, drawn from a seed."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.random_streams import random_numbers
from handeye.core.units import DEGREE, MILLIMETRE

TAUGHT: Final = 0.3 * MILLIMETRE
"""Sigma of an axis driven with the teach box. Chosen."""
STACKED: Final = 0.3 * MILLIMETRE
"""Sigma of a stack's position along X and Y. Chosen: against a mark."""
ALIGNED: Final = 0.1 * MILLIMETRE
"""Sigma of a block's position in its stack along X and Y. Chosen."""
TURNED: Final = 0.2 * DEGREE
"""Sigma of a block's yaw in its stack: as much as ALIGNED over its length."""
FRICTION: Final = (0.3, 0.5)
"""Range of friction of blocks and platter; .4 in the world without errors. Chosen: dry aluminium."""
SCALES: Final = (*3 * (0.05 * MILLIMETRE,), *3 * (2e-4,))
"""m and rad: sigma of the amplitude of a potentiometer's nonlinearity. Chosen."""
_WAVE: Final = (*3 * (0.1,), *3 * (1.0,))  # m and rad, its period
_MAX_SIGMAS: Final = 2.0  # larger errors are corrected by people


@dataclass(frozen=True, slots=True)
class BlocksWorld:
    """A world, without errors if it has no seed. Each number has a stream of its own, by name."""

    seed: int | None = None

    def normal(self, name: str, sigma: float) -> float:
        """A normal number by name, clipped at two sigma."""
        if self.seed is None:
            return 0.0
        drawn = float(random_numbers(self.seed, f"blocks.{name}").standard_normal())
        return sigma * min(max(drawn, -_MAX_SIGMAS), _MAX_SIGMAS)

    def slip(self, number: int) -> float:
        """Teaching error (m) of an axis drive, by its number from 0."""
        return self.normal(f"taught.{number}", TAUGHT)

    @property
    def friction(self) -> float:
        """Friction of blocks and platter."""
        if self.seed is None:
            return sum(FRICTION) / 2
        return float(random_numbers(self.seed, "blocks.friction").uniform(*FRICTION))

    @property
    def bending(self) -> Callable[[Array], Array]:
        """Errors (m, rad) of the six potentiometers as a function of their readings."""
        if self.seed is None:
            return np.zeros_like
        axes = range(len(SCALES))
        amplitudes = np.array([self.normal(f"scale.{axis}", SCALES[axis]) for axis in axes])
        phases = np.array([self.normal(f"scale.{axis}.phase", np.pi) for axis in axes])
        turns = 2 * np.pi / np.array(_WAVE)
        return lambda q: np.asarray(amplitudes * np.sin(turns * q + phases))
