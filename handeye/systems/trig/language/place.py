"""Places and positions of the hand. A place has six components: three along the arm's axes and three about them. A
position is a place that has a name in a program.
"""

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Final, NamedTuple, Self

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.units import DEGREE, MILLIMETRE

AXES: Final = ("X", "Y", "Z", "ROLL", "PITCH", "YAW")
SIZES: Final = (*3 * (MILLIMETRE,), *3 * (DEGREE,))  # SI value of each component's unit
UNITS: Final = (*3 * ("mm",), *3 * ("deg",))
DECIMALS: Final = 6  # of a millimetre or degree, in files

Measures = tuple[float, float, float, float, float, float]  # mm and deg, as shown and stored


class Place(NamedTuple):
    """A place of the hand, or a difference of two places (m and rad). Angles are from minus half a turn to half a
    turn.
    """

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0

    def moved(self, offset: "Place") -> Self:
        """Return the place at an offset from this one, computed component by component."""
        return self._made(a + b for a, b in zip(self, offset, strict=True))

    def seen_from(self, origin: "Place") -> Self:
        """Return the offset from `origin` to this place."""
        return self._made(a - b for a, b in zip(self, origin, strict=True))

    def turned_back(self) -> Self:
        """Return the opposite offset."""
        return self._made(-a for a in self)

    def with_axis(self, axis: int, value: float) -> Self:
        """Return a copy in which one component, numbered from 0, is replaced."""
        return self._made(value if number == axis else old for number, old in enumerate(self))

    def measures(self) -> Measures:
        """Return the components in millimetres and degrees."""
        x, y, z, *angles = (round(a / size, DECIMALS) + 0.0 for a, size in zip(self, SIZES, strict=True))
        roll, pitch, yaw = angles
        return x, y, z, roll, pitch, yaw

    @classmethod
    def measured(cls, measures: Measures) -> Self:
        """Make a place from components in millimetres and degrees."""
        return cls._made(a * size for a, size in zip(measures, SIZES, strict=True))

    @classmethod
    def _made(cls, components: Iterable[float]) -> Self:
        x, y, z, *angles = components
        return cls(x, y, z, *(math.remainder(angle, math.tau) for angle in angles))


def told_place(place: Place) -> str:
    """Return a place in words. Angles are included only if they are not 0."""
    told = [f"{axis} {value:.4g}" for axis, value in zip(AXES, place.measures(), strict=True)]
    return " ".join(told[:3] + [word for word, angle in zip(told[3:], place[3:], strict=True) if angle])


LONGEST: Final = 40  # characters of a name
NAME: Final = re.compile(r"[A-Z][A-Z0-9_-]*", re.ASCII)
_UNNAMED: Final = "_"  # prefix of positions without a name


@dataclass(slots=True, kw_only=True)
class Position:
    """An absolute place, or an offset from the arm's present place."""

    relative: bool
    init: Place  # as defined; a run from the top starts with it
    data: Place  # present value, which SAVPOS changes
    unread: Mapping[str, object] = field(default_factory=dict)  # file fields unknown to this version


Positions = dict[str, Position]  # by name; positions of single steps have names that cannot be typed


def name_of(word: str) -> str:
    """Return a name in capitals. Raises BadArgument if the word cannot be a name."""
    if len(word) > LONGEST:
        raise BadArgument(f"{quoted(word)} has {len(word)} characters; a name can have at most {LONGEST}")
    if not NAME.fullmatch(word.upper()) or not word.isascii():
        raise BadArgument(
            f"{quoted(word)} is not a name: a name is a letter, followed by letters, digits, `-` or `_`"
        )
    return word.upper()


def is_named(name: str) -> bool:
    """Return True if the user gave the name."""
    return not name.startswith(_UNNAMED)


def free_name(positions: Positions) -> str:
    """Return a new name for an unnamed position."""
    number = 1 + max((int(name[1:]) for name in positions if not is_named(name)), default=0)
    return f"{_UNNAMED}{number}"
