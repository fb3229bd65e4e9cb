"""The worlds of the rectilinear arm. The seed of a world determines the errors of the slides, the wand, the strain
gauges and the range finder.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.distributions import Distribution, Fixed, Noise, random_numbers
from handeye.core.variation import Quantity, Variation, WorldSpec

REPEATABILITY: Final = "slides.repeatability"
SLIDES: Final = "slides.bend"
TURNS: Final = "turns.bend"
THRESHOLD: Final = "wand.threshold"
STIFFNESS: Final = "wand.stiffness"
GAIN: Final = "strain.gain"
ZERO: Final = "strain.zero"
DRIFT: Final = "strain.drift"
NOISE: Final = "strain.noise"
RANGE: Final = "range.noise"
CONE: Final = "range.cone"
_CLIPPED: Final = 2.0  # sigmas


def quantity(
    name: str, unit: str, drawn: Distribution, most: float, source: str, nominal: float = 0.0
) -> Quantity:
    """Return a quantity that can be set to values from 0 to `most` (in its own unit)."""
    return Quantity(
        name=name, unit=unit, distribution=drawn, nominal=nominal, limits=(0.0, most), source=source
    )


ARM: Final = (
    quantity(
        REPEATABILITY,
        "mm",
        Fixed(0.38),
        4.0,
        "Full width of the range in which a slide stops. Each motion stops at a random place in this range, "
        "uniformly distributed. In the paper, the width is about .38 mm.",
    ),
    quantity(
        SLIDES,
        "mm",
        Noise(0.05),
        5.0,
        "Standard deviation of the nonlinearity of a slide's potentiometer. No source: our choice.",
    ),
    quantity(
        TURNS,
        "rad",
        Noise(2e-4),
        0.1,
        "Standard deviation of the nonlinearity of a rotary potentiometer. No source: our choice.",
    ),
    quantity(
        THRESHOLD,
        "mm",
        Noise(0.01),
        0.05,
        "Standard deviation of the deflection at which the wand signals a contact; the nominal deflection is .1 mm. "
        "No source: our choice.",
    ),
    quantity(
        STIFFNESS,
        "",
        Noise(0.05),
        0.4,
        "Standard deviation of the wand's stiffness, as a fraction of the nominal stiffness. No source: our choice.",
    ),
    quantity(
        GAIN,
        "",
        Noise(0.02),
        0.4,
        "Standard deviation of a strain gauge's gain, as a fraction of the nominal gain. No source: our choice.",
    ),
    quantity(
        ZERO,
        "N",
        Noise(0.05),
        2.0,
        "Standard deviation of a strain gauge's zero when the power is switched on. No source: our choice.",
    ),
    quantity(
        DRIFT,
        "N",
        Noise(0.05),
        2.0,
        "Standard deviation of the drift per minute of a strain gauge's zero. No source: our choice, about 5 g.",
    ),
    quantity(
        NOISE,
        "N",
        Noise(0.02),
        1.0,
        "Standard deviation of a strain gauge's noise. Our choice: this noise keeps the error of a reading below "
        "the 5 g of the paper.",
    ),
    quantity(
        RANGE,
        "mm",
        Noise(1.0),
        50.0,
        "Standard deviation of the error of a measured range. The paper says that ranges are accurate to about 2 mm.",
    ),
    quantity(
        CONE,
        "deg",
        Fixed(8.0),
        20.0,
        "Half the angle of the range finder's cone. The range finder measures the distance of the nearest object "
        "in this cone. No source: our choice.",
        8.0,
    ),
)


ALONE: Final = Variation(*ARM)
"""The quantities of a world that has only the arm, without a job."""


@dataclass(frozen=True, slots=True)
class ArmWorld:
    """A world of the arm and of a job. A world without a specification has no errors. Each number has its own random
    stream, and the number's name selects this stream.
    """

    spec: WorldSpec | None = None
    variation: Variation = ALONE

    def value(self, name: str) -> float:
        """Return the value of a quantity in the world (SI)."""
        if self.spec is None:
            nominal = self.variation.quantities[name]
            return nominal.nominal * nominal.measure.size
        return self.variation.value(name, self.spec)

    def fault(self, name: str) -> float | None:
        """Return the size of a fault (SI; 1 for a fault without a size), or None if the world does not have the
        fault.
        """
        faults = () if self.spec is None else self.spec.faults
        return next((1.0 if each.value is None else each.value for each in faults if each.name == name), None)

    def normal(self, name: str, sigma: str) -> float:
        """Draw the normally distributed number called `name`. The standard deviation is the world's value of the
        quantity `sigma`, and the number is clipped at two standard deviations.
        """
        if self.spec is None:
            return 0.0
        drawn = float(self.numbers(name).standard_normal())
        return min(max(drawn, -_CLIPPED), _CLIPPED) * self.value(sigma)

    def numbers(self, name: str) -> np.random.Generator:
        """Return the random number generator of the stream called `name`."""
        return random_numbers(0 if self.spec is None else self.spec.seed, f"rectilinear.{name}")

    @property
    def wand_stiffness(self) -> float:
        """Stiffness of the wand, relative to the nominal stiffness."""
        return 1.0 + self.normal("wand.stiffness", STIFFNESS)
