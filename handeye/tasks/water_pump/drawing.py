"""Figures that follow from the dimensions: where holes and parts are."""

import math
from functools import cache

from handeye.core.pose import Pose, planar
from handeye.tasks.water_pump.dimensions import dimensions

Point = tuple[float, float]


@cache
def screw_holes(count: int = 6) -> tuple[Point, ...]:
    """Centres of the screw holes in part coordinates, m: four around large hole 1, two beside 2, perhaps a seventh."""
    d = dimensions()
    r1, r2, x2 = d("base.screw_holes.radius_1"), d("base.screw_holes.radius_2"), d("base.large_hole_2.x")
    first = [(r1 * math.cos(a), r1 * math.sin(a)) for a in d.all("base.screw_holes.directions_1")]
    second = [(x2 + r2 * math.cos(a), r2 * math.sin(a)) for a in d.all("base.screw_holes.directions_2")]
    x7, y7 = d.all("base.screw_holes.seventh")
    return (*first, *second, (x7, y7))[:count]


def base_top() -> float:
    """Height of the base's machined face over its underside, m."""
    d = dimensions()
    return d("base.plate.thickness") + d("base.casting.height")


def pin_seat(chamfer: float, radius: float) -> float:
    """Height over a hole's mouth (m, negative) where a pin's shoulder rests in its 45 degree chamfer."""
    return min(0.0, dimensions()("pin.body_radius") - radius - chamfer)


def standard() -> Pose:
    """`X_WP` of the base in its standard position."""
    d = dimensions()
    x, y = d.all("standard.place")
    return planar(x, y, 0.0, d("standard.yaw"))


def dispenser_places(count: int = 6) -> tuple[Point, ...]:
    """Where the screws stand, in the table frame, m; a seventh behind the others."""
    d = dimensions()
    x, y = d.all("dispenser.place")
    return tuple((x, y + (k - 2.5) * d("dispenser.pitch")) for k in range(count))


def web_centre() -> float:
    """Distance along x from large hole 1 to the middle of the gasket's web, m."""
    d = dimensions()
    edge_1 = d("base.large_hole_1.diameter") / 2
    edge_2 = d("base.large_hole_2.x") - d("base.large_hole_2.diameter") / 2
    return (edge_1 + edge_2) / 2
