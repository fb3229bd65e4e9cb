"""The worlds of the block bench. The seed of a world determines the errors of the teaching, of the machine and of the
blocks' poses.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.distributions import Distribution, Noise, Range, random_numbers
from handeye.core.faults import Catalogue, ExpectedDetection, FaultKind, Size
from handeye.core.pose import Array
from handeye.core.variation import Quantity, Variation, WorldSpec

TAUGHT: Final = "taught"
STACKED: Final = "stack.place"
ALIGNED: Final = "block.place"
TURNED: Final = "block.turn"
FRICTION: Final = "blocks.friction"
SLIDES: Final = "axes.slide"
TURNS: Final = "axes.turn"


def _quantity(name: str, unit: str, distribution: Distribution, most: float, source: str) -> Quantity:
    nominal = 0.4 if name == FRICTION else 0.0
    return Quantity(
        name=name, unit=unit, distribution=distribution, nominal=nominal, limits=(0.0, most), source=source
    )


VARIATION: Final = Variation(
    _quantity(
        TAUGHT,
        "mm",
        Noise(0.3),
        5.0,
        "Standard deviation of the position of an axis that is driven with the teach box. No source: our choice.",
    ),
    _quantity(
        STACKED,
        "mm",
        Noise(0.3),
        5.0,
        "Standard deviation of a stack's position along X and Y. "
        "No source: our choice, for a stack that a person places at a mark.",
    ),
    _quantity(
        ALIGNED,
        "mm",
        Noise(0.1),
        5.0,
        "Standard deviation of a block's position in its stack along X and Y. No source: our choice.",
    ),
    _quantity(
        TURNED,
        "deg",
        Noise(0.2),
        10.0,
        "Standard deviation of a block's yaw in its stack. No source: our choice.",
    ),
    _quantity(
        FRICTION,
        "",
        Range(0.3, 0.5),
        2.0,
        "Coefficient of friction of a block on the platter and on another block. No source: our choice, for dry "
        "aluminium.",
    ),
    _quantity(
        SLIDES,
        "mm",
        Noise(0.05),
        5.0,
        "Standard deviation of the nonlinearity of linear potentiometers. No source: our choice.",
    ),
    _quantity(
        TURNS,
        "rad",
        Noise(2e-4),
        0.1,
        "Standard deviation of the nonlinearity of rotary potentiometers. No source: our choice.",
    ),
)  # quantities of the bench: the friction, and sigmas of errors; each error has a stream of its own
WEAK, HEAVY, SLIPPERY = "hand.weak", "blocks.heavy", "platter.slippery"
FAULTS: Final = Catalogue(
    FaultKind(
        name=WEAK, meaning=(
            "The hand presses with only this force. Without the fault, the force is 30 N."
        ), when="before",
        size=Size(unit="N", usual=0.1, limits=(0.001, 30.0)),
    ),
    FaultKind(
        name=HEAVY, meaning="The blocks weigh this many times as much as aluminium blocks.", when="before",
        size=Size(unit="", usual=10.0, limits=(1.0, 100.0)),
        expected=ExpectedDetection(harmless="The hand can hold a hundred times the weight of a block."),
    ),
    FaultKind(
        name=SLIPPERY, meaning=(
            "Blocks and platter are oiled: their friction coefficient has this value."
        ), when="before",
        size=Size(unit="", usual=0.05, limits=(0.01, 0.3)),
        expected=ExpectedDetection(
            harmless="Blocks stay flat where they are put, and the hand holds them with its full force."
        ),
    ),
)  # fmt: skip
_WAVE: Final = (*3 * (0.1,), *3 * (1.0,))  # m and rad, period of a potentiometer's error
_MAX_SIGMAS: Final = 2.0  # people notice and correct larger errors


@dataclass(frozen=True, slots=True)
class BlocksWorld:
    """A world of the block bench. A world without a specification has no errors. Each number has its own random
    stream, and the number's name selects this stream.
    """

    spec: WorldSpec | None = None

    def fault(self, name: str) -> float | None:
        """Return the size of a fault (SI), or None if the world does not have the fault."""
        faults = () if self.spec is None else self.spec.faults
        return next((fault.value for fault in faults if fault.name == name), None)

    def normal(self, name: str, quantity: str) -> float:
        """Draw the normally distributed number called `name`. The standard deviation is the world's value of
        `quantity`; the number is clipped at two standard deviations.
        """
        return 0.0 if self.spec is None else VARIATION.value(quantity, self.spec) * self._drawn(name)

    def _drawn(self, name: str) -> float:
        """Draw the standard normal number called `name`, clipped at two standard deviations."""
        assert self.spec is not None
        drawn = float(random_numbers(self.spec.seed, f"blocks.{name}").standard_normal())
        return min(max(drawn, -_MAX_SIGMAS), _MAX_SIGMAS)

    def slip(self, number: int) -> float:
        """Return the teaching error (m) of one jog of an axis. Jogs are numbered from 0."""
        return self.normal(f"taught.{number}", TAUGHT)

    @property
    def friction(self) -> float:
        if (slippery := self.fault(SLIPPERY)) is not None:
            return slippery
        return (
            VARIATION.quantities[FRICTION].nominal
            if self.spec is None
            else VARIATION.value(FRICTION, self.spec)
        )

    @property
    def bending(self) -> Callable[[Array], Array]:
        """A function that takes the readings of the six potentiometers (m or rad) and returns the errors of these
        readings.
        """
        if self.spec is None:
            return np.zeros_like
        sigmas = [*3 * (SLIDES,), *3 * (TURNS,)]
        amplitudes = np.array([self.normal(f"scale.{axis}", sigma) for axis, sigma in enumerate(sigmas)])
        phases = np.array([np.pi * self._drawn(f"scale.{axis}.phase") for axis in range(len(sigmas))])
        turns = 2 * np.pi / np.array(_WAVE)
        return lambda q: np.asarray(amplitudes * np.sin(turns * q + phases))
