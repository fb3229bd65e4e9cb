"""Units of 1973 with their SI values, and two constants that the language and the arm of 1973 share.

Inside the program all quantities are in SI units: metres, radians, newtons, newton metres, seconds.
"""

import math
import re
from collections.abc import Sequence
from typing import Final

from handeye.core.record import Record

INCH: Final = 0.0254  # m, exact by definition
MILLIMETRE: Final = 0.001  # m
DEGREE: Final = math.pi / 180  # rad
OUNCE_FORCE: Final = 0.27801385095378125  # N, avoirdupois ounce times standard gravity
OUNCE_INCH: Final = OUNCE_FORCE * INCH  # N m
RPM: Final = 2 * math.pi / 60  # rad/s
JIFFY: Final = 1 / 60  # s, the servo period of the 1973 arm program
GAP: Final = 0.105  # m, the widest opening of its hand [Scheinman's data sheet, 1974]
PERCENT: Final = 0.01


class Unit(Record, frozen=True):
    """A unit as it is written after a number, with its SI value."""

    name: str
    dimension: str
    size: float


UNITS: Final = {
    unit.name: unit
    for unit in (
        Unit("in", "length", INCH),
        Unit("mm", "length", MILLIMETRE),
        Unit("m", "length", 1.0),
        Unit("deg", "angle", DEGREE),
        Unit("rad", "angle", 1.0),
        Unit("oz", "force", OUNCE_FORCE),
        Unit("N", "force", 1.0),
        Unit("oz in", "torque", OUNCE_INCH),
        Unit("N m", "torque", 1.0),
        Unit("deg/s", "angular speed", DEGREE),
        Unit("rad/s", "angular speed", 1.0),
        Unit("in/s", "speed", INCH),
        Unit("m/s", "speed", 1.0),
        Unit("%", "ratio", PERCENT),
        Unit("", "ratio", 1.0),
    )
}  # units by name; the last is that of a plain number


class Measures(Record, frozen=True, kw_only=True):
    """The units in which lengths and forces of a run are shown."""

    length: Unit
    places: int  # decimals of a length
    force: Unit

    def place(self, p: Sequence[float]) -> str:
        """Write a position (m) as text, such as `(1.00, -2.50, 0.00) in`."""
        return f"({', '.join(map(self._number, p))}) {self.length.name}"

    def distance(self, metres: float) -> str:
        """Write a length (m) as text in the unit of lengths."""
        return f"{self._number(metres)} {self.length.name}"

    def _number(self, metres: float) -> str:
        return f"{metres / self.length.size:z.{self.places}f}"


INCHES: Final = Measures(length=UNITS["in"], places=2, force=UNITS["oz"])
MILLIMETRES: Final = Measures(length=UNITS["mm"], places=1, force=UNITS["N"])

_WRITTEN: Final = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*?)\s*", re.IGNORECASE | re.ASCII)


def split_value(text: str) -> tuple[float, str] | None:
    """Split a text such as `.3 in` into number and unit. Returns None if the text does not begin with a number."""
    found = _WRITTEN.fullmatch(text.strip())
    return None if found is None else (float(found[1]), found[2])


def unit_named(word: str) -> Unit | None:
    """Find the unit called `word`, ignoring blanks and case. Returns None if no unit has this name."""
    spelt = {name.replace(" ", "").casefold(): unit for name, unit in UNITS.items()}
    return spelt.get(word.replace(" ", "").casefold())
