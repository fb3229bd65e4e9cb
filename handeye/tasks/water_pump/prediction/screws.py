"""Screwdriver and screws: out of the rack, over the heads, into the holes, and back."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.program.motion_operations import Height, Travel
from handeye.tasks.water_pump.prediction.assembly import Assembly
from handeye.tasks.water_pump.prediction.poses import inverses, moved, points
from handeye.tasks.water_pump.prediction.things import driver_in_rack, mouth, rack_seat, screw_head
from handeye.tasks.water_pump.threads import SQUARE
from handeye.tasks.water_pump.world.dimensions import dimensions


@dataclass(frozen=True, slots=True, kw_only=True)
class Screw:
    """A screw: its number, from 1, where it is fetched and driven, and its hole, from 0."""

    number: int
    fetched: str
    driven: str
    hole: int


_HOLES: Final = (0, 2, 5, 1, 4, 3)
"""In the order in which they are driven."""
SCREWS: Final = tuple(
    Screw(number=number, fetched=f"S{number}", driven=f"H{hole}", hole=hole)
    for number, hole in enumerate(_HOLES, 1)
)
FIRST: Final = 2
"""Screws that are driven before the pins come out."""
_RING_BEVEL: Final = 2e-3
_RING_PLAY: Final = 0.3e-3
"""m: of the ring that leads the socket over a head; scene/tool.py."""


def take_driver(assembly: Assembly, operation: str) -> Array:
    """Take the screwdriver, its place felt both ways; how it is held, `X_TP`."""
    X_WP = driver_in_rack(assembly.worlds)
    for goal, name in (("D", "DRV"), ("DX", "DRX")):
        hand = assembly.hand(goal)
        off = _axis(X_WP, hand) - hand[:, :3, 3]
        assembly.fits(operation, goal, off, dimensions()("driver.width"))
        assembly.centre(goal, name, off)
    hand, line = assembly.hand("D", way=len(assembly.ways["D"]) - 1), assembly.line("D")
    off = (_axis(X_WP, hand) - hand[:, :3, 3]) @ line
    return inverses(moved(hand, off[:, None] * line)) @ X_WP


def drive(assembly: Assembly, X_TP: Array, screws: Sequence[Screw]) -> None:
    """Fetch screws, and bring their points over their holes."""
    for screw in screws:
        _fetch(assembly, X_TP, screw)
        _bring(assembly, X_TP, screw)


def put_back(assembly: Assembly, X_TP: Array, operation: str) -> None:
    """Let the screwdriver down into its rack."""
    d = dimensions()
    foot = points(assembly.hand("DUP") @ X_TP, np.array([0.0, 0.0, -d("driver.height") / 2]))
    off = rack_seat(assembly.worlds) - foot
    assembly.meets(operation, "DUP", off, d("rack.play") + d("rack.lead"))
    assembly.window(operation, "DUP", Travel, -off[:, 2])


def _axis(X_WP: Array, hand: Array) -> Array:
    """The axis of the screwdriver, level with the fingers, shape (n, 3)."""
    up = X_WP[:, :3, 2]
    return np.asarray(X_WP[:, :3, 3] + up * ((hand[:, 2, 3] - X_WP[:, 2, 3]) / up[:, 2])[:, None])


def _bit() -> float:
    """Height of the bit's face over the middle of the block, m."""
    return -dimensions()("driver.height") / 2 - dimensions()("driver.bit")


def _fetch(assembly: Assembly, X_TP: Array, screw: Screw) -> None:
    bit = points(assembly.hand(screw.fetched) @ X_TP, np.array([0.0, 0.0, _bit()]))
    off = screw_head(assembly.worlds, screw.number) - bit
    assembly.meets(f"screw {screw.number}", screw.fetched, off, _RING_PLAY + _RING_BEVEL)
    assembly.window(f"screw {screw.number}", screw.fetched, Travel, -off[:, 2])
    assembly.save("DS", off)
    assembly.heights["DS"] = (
        assembly.planned(screw.fetched)[2, 3] + off[:, 2] - assembly.gives_at_last(screw.fetched)
    )


def _bring(assembly: Assembly, X_TP: Array, screw: Screw) -> None:
    d, operation, goal = dimensions(), f"screw {screw.number}", screw.driven
    X = assembly.hand(goal) @ X_TP
    point = np.array([0.0, 0.0, _bit() - d("screw.length") - d("screw.head_height")])
    off = mouth(assembly.worlds, screw.hole) - points(X, point)
    catch = d("top.screw_hole_radius") + d("top.chamfer_above") - d("screw.point_radius")
    assembly.meets(operation, goal, off, catch)
    stands = assembly.planned(goal)[2, 3] + off[:, 2] - _sunk()
    assembly.window(operation, goal, Height, stands)
    assembly.leans(operation, goal, np.arccos(np.clip(X[:, 2, 2], -1.0, 1.0)), SQUARE)
    assembly.heights["HS"] = stands - assembly.gives(goal)
    assembly.save("HS", off)


def _sunk() -> float:
    """How deep the point of a screw is in the base when its shank stands on the chamfer of its hole, m."""
    d = dimensions()
    chamfer = d("base.screw_holes.chamfer") - (d("screw.shank_radius") - d("base.screw_holes.radius"))
    return d("screw.point_length") + chamfer
