"""The worlds of the gantries. The seed of a world determines the errors of the switches, motors, wrists, beams and
clocks.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.distributions import Distribution, Noise, Range, random_numbers
from handeye.core.pose import Array
from handeye.core.variation import Quantity, Variation, WorldSpec
from handeye.systems.sigma.protocol import AXES

SWITCHES: Final = "switches"
FRICTION: Final = "axes.friction"
PULL_OUT: Final = "motors.pull_out"
STIFFNESS: Final = "wrists.stiffness"
GAIN: Final = "wrists.gain"
LEFT: Final = "wrists.left"
BEAM: Final = "beams.height"
CLOCKS: Final = "clocks"
ACROSS: Final = "pieces.across"
FIXTURES: Final = "fixtures.place"
_CLIPPED: Final = 2.0  # sigmas


def _quantity(
    name: str, unit: str, drawn: Distribution, most: float, source: str, nominal: float = 0.0
) -> Quantity:
    return Quantity(
        name=name, unit=unit, distribution=drawn, nominal=nominal, limits=(0.0, most), source=source
    )


VARIATION: Final = Variation(
    _quantity(
        SWITCHES,
        "mm",
        Noise(0.05),
        1.0,
        "Standard deviation of the position of a rail's switch. No source: our choice.",
    ),
    _quantity(
        FRICTION,
        "",
        Range(0.35, 0.65),
        5.0,
        "Viscous friction of an axis, in N s/m for each kilogram that the axis moves. No source: our choice.",
        0.5,
    ),
    _quantity(
        PULL_OUT,
        "",
        Noise(0.05),
        0.4,
        "Standard deviation of a motor's pull-out force, as a fraction of the nominal force. No source: our choice.",
    ),
    _quantity(
        STIFFNESS,
        "",
        Noise(0.015),
        0.4,
        "Standard deviation of a wrist's stiffness, as a fraction of the nominal stiffness. No source: our choice.",
    ),
    _quantity(
        GAIN,
        "",
        Noise(0.015),
        0.4,
        "Standard deviation of a strain gauge's gain, as a fraction of the nominal gain. No source: our choice.",
    ),
    _quantity(
        LEFT,
        "",
        Range(0.03, 0.08),
        1.0,
        "Fraction of the inertial force that remains in the reading after the correction by the accelerometers; "
        "1 without accelerometers. No source: our choice.",
        0.05,
    ),
    _quantity(
        BEAM,
        "mm",
        Noise(0.1),
        2.0,
        "Standard deviation of the height of a light beam. No source: our choice.",
    ),
    _quantity(
        CLOCKS,
        "",
        Noise(0.0025),
        0.04,
        "Standard deviation of a microcomputer's clock rate, as a fraction of the nominal rate. No source: our choice.",
    ),
    _quantity(
        ACROSS,
        "mm",
        Noise(0.5),
        5.0,
        "Standard deviation of a piece's position along x and y; for chess pieces, along y only. No source: our "
        "choice, for pieces placed by hand.",
    ),
    _quantity(
        FIXTURES,
        "mm",
        Noise(0.25),
        2.0,
        "Standard deviation of a fixture's position on the board, in x and in y, in jobs that have fixtures. "
        "No source: our choice.",
    ),
)


@dataclass(frozen=True, slots=True)
class GantryWorld:
    """A world of the gantries. A world without a specification has no errors. Each number is drawn from a random
    stream of its own. The number's name selects the stream.
    """

    spec: WorldSpec | None = None

    def value(self, quantity: str) -> float:
        """Return the value of a quantity in the world (SI)."""
        if self.spec is None:
            nominal = VARIATION.quantities[quantity]
            return nominal.nominal * nominal.measure.size
        return VARIATION.value(quantity, self.spec)

    def normal(self, name: str, quantity: str) -> float:
        """Draw the normally distributed number called `name`. The number's standard deviation is the world's value of
        `quantity`. The number is clipped at two standard deviations.
        """
        if self.spec is None:
            return 0.0
        drawn = float(self.numbers(name).standard_normal())
        return min(max(drawn, -_CLIPPED), _CLIPPED) * self.value(quantity)

    def numbers(self, name: str) -> np.random.Generator:
        """Return the random number generator of the stream called `name`."""
        return random_numbers(0 if self.spec is None else self.spec.seed, f"gantries.{name}")

    def axes(self, quantity: str, axes: Sequence[str] = AXES) -> Array:
        """Draw a normally distributed number for each axis, shape (axes,)."""
        return np.array([self.normal(f"{quantity}.{axis}", quantity) for axis in axes])

    @property
    def clock_spread(self) -> float:
        """Greatest clock error of the microcomputers, as a fraction."""
        return _CLIPPED * self.value(CLOCKS)
