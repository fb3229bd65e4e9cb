"""Place: where the hand is, as six components along and about the arm's own axes."""

import math
from collections.abc import Iterable
from typing import Final, NamedTuple, Self

from handeye.core.units import DEGREE, MILLIMETRE

AXES: Final = ("X", "Y", "Z", "ROLL", "PITCH", "YAW")
SIZES: Final = (*3 * (MILLIMETRE,), *3 * (DEGREE,))
"""Of the units in which people are told the components, m and rad."""
UNITS: Final = (*3 * ("mm",), *3 * ("deg",))
DECIMALS: Final = 6
"""Of a millimetre or a degree, in files."""

Measures = tuple[float, float, float, float, float, float]
"""Components in millimetres and degrees, as people and files have them."""


class Place(NamedTuple):
    """A place of the hand, or the difference of two, m and rad. Angles lie within half a turn of 0."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0

    def moved(self, offset: "Place") -> Self:
        """The place that lies an offset away, component by component."""
        return self._made(a + b for a, b in zip(self, offset, strict=True))

    def seen_from(self, origin: "Place") -> Self:
        """The offset that leads here from another place."""
        return self._made(a - b for a, b in zip(self, origin, strict=True))

    def turned_back(self) -> Self:
        """The offset that leads the other way."""
        return self._made(-a for a in self)

    def with_axis(self, axis: int, value: float) -> Self:
        """The place with one component, by its number from 0, replaced."""
        return self._made(value if number == axis else old for number, old in enumerate(self))

    def measures(self) -> Measures:
        """Its components in millimetres and degrees."""
        x, y, z, *angles = (round(a / size, DECIMALS) + 0.0 for a, size in zip(self, SIZES, strict=True))
        roll, pitch, yaw = angles
        return x, y, z, roll, pitch, yaw

    @classmethod
    def measured(cls, measures: Measures) -> Self:
        """The place of components in millimetres and degrees."""
        return cls._made(a * size for a, size in zip(measures, SIZES, strict=True))

    @classmethod
    def _made(cls, components: Iterable[float]) -> Self:
        x, y, z, *angles = components
        return cls(x, y, z, *(math.remainder(angle, math.tau) for angle in angles))


def told_place(place: Place) -> str:
    """A place in words: lengths always, angles where there are any."""
    told = [f"{axis} {value:.4g}" for axis, value in zip(AXES, place.measures(), strict=True)]
    return " ".join(told[:3] + [word for word, angle in zip(told[3:], place[3:], strict=True) if angle])
