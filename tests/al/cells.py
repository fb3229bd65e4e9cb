"""Work cells out of words, for the examples of the manual.

The default is a perfect arm in an empty room. Lines put something there:

    solid below z 3.5
    solid below z 3.75 with a hole .2 wide at 25.07 38 down to 2.9
    solid beyond y 40
    .24 between the fingers
    .24 between the fingers below z 3.2
    the driver meets 50 oz-in

Or they ask for the simulated cell, in which nothing is off but what they say:

    the simulated cell
    the base in its standard position

Numbers are inches, in table coordinates.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from compiled_mechanics import CompiledMechanics
from fakes import FakeCell, Wall
from pump_bench import at_standard, put, settle

from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array
from handeye.core.units import INCH, OUNCE_INCH
from handeye.ports.workcell import Workcell
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.pump_world import PumpWorld

SIMULATED = "the simulated cell"


@dataclass(frozen=True, kw_only=True)
class Plate(Wall):
    """A wall that faces up, with a round hole in it."""

    centre: tuple[float, float]
    radius: float
    floor: float
    """Height of the bottom of the hole, m."""

    def force(self, p: Array, v: Array) -> Array:
        if np.hypot(*(p[:2] - self.centre)) > self.radius:
            return super().force(p, v)
        return Wall(point=(0.0, 0.0, self.floor)).force(p, v)


def cell_of(words: str, q: Array) -> Workcell:
    """The cell that `words` describe, the arm standing at `q` if nothing else is said."""
    lines = words.splitlines()
    if SIMULATED in lines:
        return _simulated(lines)
    cell = FakeCell(q, CompiledMechanics())
    for line in lines:
        _furnish(cell, line)
    return cell.devices


def _simulated(lines: list[str]) -> Workcell:
    cell = build_cell(PumpWorld.nominal(), camera="ray")
    assert set(lines) <= {SIMULATED, "the base in its standard position"}, lines
    if len(lines) > 1:
        put(cell, "base", at_standard()["base"])
    settle(cell)
    return cell.devices


N = r"(-?[\d.]+)"


def _furnish(cell: FakeCell, line: str) -> None:
    for pattern, act in _LINES.items():
        found = re.fullmatch(pattern, line)
        if found is not None:
            act(cell, *map(float, found.groups()))
            return
    raise AssertionError(f"no cell can be furnished with {line!r}")


def _below(cell: FakeCell, z: float) -> None:
    cell.arm.walls.append(Wall(point=(0.0, 0.0, z * INCH)))


def _plate(cell: FakeCell, z: float, wide: float, x: float, y: float, floor: float) -> None:
    centre = (x * INCH, y * INCH)
    plate = Plate(point=(0, 0, z * INCH), centre=centre, radius=wide / 2 * INCH, floor=floor * INCH)
    cell.arm.walls.append(plate)


def _beyond_x(cell: FakeCell, x: float) -> None:
    cell.arm.walls.append(Wall(point=(x * INCH, 0.0, 0.0), normal=(-1.0, 0.0, 0.0)))


def _beyond_y(cell: FakeCell, y: float) -> None:
    cell.arm.walls.append(Wall(point=(0.0, y * INCH, 0.0), normal=(0.0, -1.0, 0.0)))


def _between(cell: FakeCell, thick: float, below: float = 1000.0) -> None:
    cell.hand.thickness = lambda p: thick * INCH if p[2] < below * INCH else 0.0


def _driver(cell: FakeCell, torque: float) -> None:
    cell.screwdriver.load = torque * OUNCE_INCH


_LINES: dict[str, Callable[..., None]] = {
    f"solid below z {N}": _below,
    f"solid below z {N} with a hole {N} wide at {N} {N} down to {N}": _plate,
    f"solid beyond x {N}": _beyond_x,
    f"solid beyond y {N}": _beyond_y,
    f"{N} between the fingers": _between,
    f"{N} between the fingers below z {N}": _between,
    f"the driver meets {N} oz-in": _driver,
}

ARM = STANFORD
"""The arm that is in all of them."""
