"""Reads the dimensions of the work cell from `scenes/water_pump/dimensions.toml`, converts them to SI units,
and computes further dimensions from them.
"""

import math
import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import numpy as np

from handeye.core.errors import BadFile
from handeye.core.plain_text import counted
from handeye.core.pose import Pose, planar
from handeye.core.resources import scenes
from handeye.core.units import DEGREE, INCH

Point = tuple[float, float]

PARK: Final = np.array([-19.7, 104.0, 17.5, 0.0, 76.0, 70.3]) * [
    DEGREE, DEGREE, INCH, DEGREE, DEGREE, DEGREE
]  # fmt: skip
"""Joint positions of the parked arm. The hand points down and is at (20, 28, 8) inches: layout study, section 2."""

UNITS: Final = {
    "in": INCH,
    "mm": 1e-3,
    "m": 1.0,
    "deg": DEGREE,
    "kg": 1.0,
    "kg/m3": 1.0,
    "N": 1.0,
    "N m": 1.0,
    "1": 1.0,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """One dimension or other figure of the cell, with its unit and source."""

    values: tuple[float, ...]  # SI; one value for a single number
    unit: str  # unit of the figure in the file
    source: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Dimensions:
    """All figures of the cell, by dotted names such as `base.plate.length`."""

    figures: dict[str, Figure]

    def __call__(self, name: str) -> float:
        """Return a single figure in SI units. Raises InvalidInput if there is no such figure, or if it is a
        list."""
        values = self.all(name)
        if len(values) != 1:
            raise BadFile(
                f"the dimension `{name}` must be a single number, not a list of {counted(len(values), 'number')}"
            )
        return values[0]

    def all(self, name: str) -> tuple[float, ...]:
        """Return all figures of a list in SI units. Raises InvalidInput if there is no such list."""
        try:
            return self.figures[name].values
        except KeyError:
            raise BadFile(f"the scene has no dimension `{name}`") from None


def parse(text: str) -> Dimensions:
    """Parse dimensions from TOML text. Raises InvalidInput if the text is not TOML, or if a figure lacks a
    value, a known unit or a source.
    """
    try:
        tree = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise BadFile(f"the dimensions cannot be read: {error}") from error
    figures: dict[str, Figure] = {}
    _collect(tree, "", figures)
    return Dimensions(figures=figures)


@cache
def dimensions() -> Dimensions:
    """Return the figures of the water-pump work cell."""
    return parse((scenes() / "water_pump" / "dimensions.toml").read_text(encoding="utf-8"))


def _collect(table: dict[str, Any], prefix: str, figures: dict[str, Figure]) -> None:
    for key, entry in table.items():
        name = prefix + key
        if not isinstance(entry, dict):
            raise BadFile(f"the dimension `{name}` needs value, unit and source")
        if "value" in entry:
            figures[name] = _figure(name, entry)
        else:
            _collect(entry, name + ".", figures)


def _figure(name: str, entry: dict[str, Any]) -> Figure:
    value, unit, source = entry["value"], entry.get("unit"), entry.get("source")
    if unit not in UNITS:
        raise BadFile(
            f"the dimension `{name}` has the unknown unit {unit!r}; the units are {', '.join(UNITS)}"
        )
    if not isinstance(source, str) or not source:
        raise BadFile(f"the dimension `{name}` has no source")
    values = value if isinstance(value, list) else [value]
    if not values or not all(isinstance(v, int | float) and not isinstance(v, bool) for v in values):
        raise BadFile(f"the value of the dimension `{name}` is not a number or a list of numbers")
    return Figure(values=tuple(float(v) * UNITS[unit] for v in values), unit=unit, source=source)


@cache
def screw_holes(count: int = 6) -> tuple[Point, ...]:
    """Return the centres of the screw holes in part coordinates (m): four around large hole 1, two beside large
    hole 2 and, if `count` is 7, a seventh.
    """
    d = dimensions()
    r1, r2, x2 = d("base.screw_holes.radius_1"), d("base.screw_holes.radius_2"), d("base.large_hole_2.x")
    first = [(r1 * math.cos(a), r1 * math.sin(a)) for a in d.all("base.screw_holes.directions_1")]
    second = [(x2 + r2 * math.cos(a), r2 * math.sin(a)) for a in d.all("base.screw_holes.directions_2")]
    x7, y7 = d.all("base.screw_holes.seventh")
    return (*first, *second, (x7, y7))[:count]


def base_top() -> float:
    """Return the height of the base's machined face above its underside (m)."""
    d = dimensions()
    return d("base.plate.thickness") + d("base.casting.height")


def pin_seat(chamfer: float, radius: float) -> float:
    """Return the height (m) of a pin's shoulder above the mouth of the hole. The shoulder rests in the 45 degree
    chamfer of the hole. The height is negative if the shoulder is below the mouth. `chamfer` and `radius` are in m.
    """
    return min(0.0, dimensions()("pin.body_radius") - radius - chamfer)


def standard() -> Pose:
    """Return the pose `X_WP` of the base in its standard position."""
    d = dimensions()
    x, y = d.all("standard.place")
    return planar(x, y, 0.0, d("standard.yaw"))


def dispenser_places(count: int = 6) -> tuple[Point, ...]:
    """Return the table-frame positions (m) of the screws that hang in the dispenser."""
    d = dimensions()
    x, y = d.all("dispenser.place")
    return tuple((x, y + (k - 2.5) * d("dispenser.pitch")) for k in range(count))


def web_centre() -> float:
    """Return the distance (m) along x from the centre of large hole 1 to the middle of the gasket's web. The web is
    the strip between the two large holes.
    """
    d = dimensions()
    edge_1 = d("base.large_hole_1.diameter") / 2
    edge_2 = d("base.large_hole_2.x") - d("base.large_hole_2.diameter") / 2
    return (edge_1 + edge_2) / 2
