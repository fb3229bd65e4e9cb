"""Where fixtures, parts and holes truly are in many worlds; W and m."""

import numpy as np

from handeye.core.pose import Array, planar
from handeye.tasks.water_pump.prediction.poses import placed, points
from handeye.tasks.water_pump.prediction.worlds import Worlds
from handeye.tasks.water_pump.world.dimensions import (
    Point,
    base_top,
    dimensions,
    dispenser_places,
    pin_seat,
    screw_holes,
    standard,
    web_centre,
)
from handeye.tasks.water_pump.world.stations import Station

_LEVEL = ("x", "y", "yaw")
_TILTED = (*_LEVEL, "z", "pitch", "roll")
_HOLES = len(screw_holes())


def standing_base(worlds: Worlds) -> Array:
    """The base in its standard position, flat on the table against both blocks: poses, as the next ones."""
    d = dimensions()
    corner = d.all("blocks.left")[2], d.all("blocks.far")[1], 0.0
    return placed(worlds, f"fixtures.{Station.BLOCKS}", corner, _LEVEL) @ standard()


def pin_in_holder(worlds: Worlds, pin: int) -> Array:
    """A pin in its holder."""
    x0, y0, x1, y1 = dimensions().all("pin_holder.places")
    fixture = _fixture(worlds, Station.PIN_HOLDER, ((x0 + x1) / 2, (y0 + y1) / 2))
    return fixture @ planar(*((x0, y0), (x1, y1))[pin], seat_in_holder(), 0.0)


def seat_in_holder() -> float:
    """Height of a pin's shoulder in its holder as drawn."""
    d = dimensions()
    return d("pin_holder.height") + pin_seat(d("pin_holder.chamfer"), d("pin_holder.hole_radius"))


def layer_on_stand(worlds: Worlds, layer: str) -> Array:
    """Gasket or top on its stand, as a person has put it there."""
    station = {"gasket": Station.GASKET_STAND, "top": Station.TOP_STAND}[layer]
    x, y, z, turn = drawn_on_stand(layer)
    person = placed(worlds, f"parts.{layer}", (x, y, z), _LEVEL)
    return _fixture(worlds, station, dimensions().all(f"{station}.grasp")) @ person @ planar(x, y, z, turn)


def drawn_on_stand(layer: str) -> tuple[float, float, float, float]:
    """The place of gasket or top on its stand as drawn: x, y, z and yaw."""
    d = dimensions()
    x, y = d.all(f"{layer}_stand.grasp")
    aside = web_centre() if layer == "gasket" else 0.0
    return x + aside, y, d(f"{layer}_stand.height"), d("standard.yaw")


def driver_in_rack(worlds: Worlds) -> Array:
    """The screwdriver in its rack: the middle of its block."""
    d = dimensions()
    x, y = d.all("rack.place")
    z = d("rack.height") + d("driver.height") / 2
    play = np.pad(worlds.each("parts.driver.x", "parts.driver.y") * d("rack.play"), ((0, 0), (0, 1)))
    X = _fixture(worlds, Station.RACK, (x, y)) @ planar(x, y, z, 0.0)
    X[:, :3, 3] += play
    return X


def rack_seat(worlds: Worlds) -> Array:
    """Where the foot of the screwdriver's block stands, shape (n, 3)."""
    x, y = dimensions().all("rack.place")
    return points(_fixture(worlds, Station.RACK, (x, y)), np.array([x, y, dimensions()("rack.height")]))


def screw_head(worlds: Worlds, number: int) -> Array:
    """The upper side of the head of a screw, from 1, in the dispenser, shape (n, 3)."""
    d = dimensions()
    x, y = dispenser_places()[number - 1]
    play = d("dispenser.hole_radius") - d("screw.shank_radius")
    share = worlds.each(f"parts.screws.{number}.x", f"parts.screws.{number}.y")
    there = np.array([x, y, d("dispenser.height") + d("screw.head_height")])
    middle = dimensions().all("dispenser.place")
    return points(_fixture(worlds, Station.DISPENSER, middle), there + np.pad(share * play, ((0, 0), (0, 1))))


def drilled(worlds: Worlds, part: str) -> Array:
    """The screw holes of a part in its own frame, shape (n, 6, 2)."""
    names = [(f"holes.{part}.{hole}.x", f"holes.{part}.{hole}.y") for hole in range(1, _HOLES + 1)]
    return np.array(screw_holes()) + np.stack([worlds.each(*pair) for pair in names], axis=1)


def mouth(worlds: Worlds, hole: int) -> Array:
    """The mouth of a tapped hole, from 0, of the base in its standard position, shape (n, 3)."""
    xy = drilled(worlds, "base")[:, hole]
    return points(standing_base(worlds), np.column_stack([xy, np.full(len(xy), base_top())]))


def pinned() -> tuple[int, ...]:
    """The tapped holes that take the aligning pins."""
    return tuple(int(hole) for hole in dimensions().all("base.screw_holes.pinned"))


def _fixture(worlds: Worlds, station: str, middle: Point | tuple[float, ...]) -> Array:
    x, y = middle
    return placed(worlds, f"fixtures.{station}", (x, y, 0.0), _TILTED)
