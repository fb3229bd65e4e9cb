"""A clock on the left wall, for people: its hands show the cell's clock."""

import math
from typing import Final

import mujoco

from handeye.cell.clock_hands import TURNS
from handeye.tasks.water_pump.scene.room import LEFT
from handeye.tasks.water_pump.scene.shapes import Shaper

_X, _Y, _Z = LEFT + 0.03, 0.30, 0.56
"""Middle of the clock, m; who looks at it has y on the right and z above."""
_UPRIGHT: Final = [0.5, 0.5, 0.5, 0.5]
"""Quaternion of a frame whose z is away from the wall, and whose y is up."""
_HANDS: Final = {
    "hour": (43200.0, 0.085, 0.007),
    "minute": (3600.0, 0.125, 0.005),
    "second": (60.0, 0.135, 0.002),
}
"""Seconds of a turn, length and half the width (m)."""


def add_clock(shaper: Shaper) -> None:
    """The clock; each of its hands is a body."""
    wall = shaper.spec.worldbody
    for name, radius, back, front, material in (
        ("clock_case", 0.165, -0.03, 0.008, "black"),
        ("clock_face", 0.150, 0.0, 0.012, "paper"),
        ("clock_hub", 0.008, 0.012, 0.022, "black"),
    ):
        shaper.cylinder(wall, "scenery", radius, (_X + back, _Y, _Z), (_X + front, _Y, _Z), material, name)
    for hour in range(12):
        _add_mark(shaper, hour)
    for layer, (name, (_, length, half)) in enumerate(_HANDS.items()):
        z, material = 0.014 + 0.002 * layer, "red" if name == "second" else "black"
        hand = wall.add_body(name=f"{name}_hand", pos=[_X, _Y, _Z], quat=_UPRIGHT)
        shaper.box(hand, "scenery", (-half, -0.02, z), (half, length, z + 0.001), material, f"{name}_hand")
    for name, (period, _, _) in _HANDS.items():
        shaper.spec.add_numeric(name=f"{TURNS}{name}_hand", data=[period])


def _add_mark(shaper: Shaper, hour: int) -> None:
    """The mark of an hour, long at every third."""
    half, angle = 0.013 if hour % 3 == 0 else 0.007, math.pi * hour / 6
    middle = 0.140 - half
    shaper.spec.worldbody.add_geom(
        shaper.style("scenery"), name=f"clock_mark{hour}", type=mujoco.mjtGeom.mjGEOM_BOX, material="black",
        size=[0.001, 0.003, half], pos=[_X + 0.012, _Y + middle * math.sin(angle), _Z + middle * math.cos(angle)],
        quat=[math.cos(angle / 2), -math.sin(angle / 2), 0.0, 0.0],
    )  # fmt: skip
