"""Cables of the wrist's motors along the boom, for people: they go with it."""

import math

import numpy as np

from handeye.tasks.water_pump.scene import solids
from handeye.tasks.water_pump.scene.arm import ARM
from handeye.tasks.water_pump.scene.shapes import Shaper

_SIDE, _MIDDLE = -0.0352, 0.020
"""x and y of the cables in the boom's frame, m."""
_BACK, _FRONT = -1.36, -0.10
"""From where to where along the boom they go, m."""


def add_boom_cables(shaper: Shaper) -> None:
    """Three cables in clips, and the loop in which they leave the motor behind the boom's end."""
    boom = shaper.spec.body(f"{ARM}link3")
    for number, y in enumerate((_MIDDLE - 0.006, _MIDDLE, _MIDDLE + 0.006)):
        start, end = (_SIDE, y, _BACK), (_SIDE, y, _FRONT)
        shaper.cylinder(boom, "scenery", 0.0024, start, end, "black", f"boom_cable{number}")
    for number, z in enumerate(np.linspace(_BACK + 0.05, _FRONT - 0.05, 8)):
        low, high = (-0.0385, _MIDDLE - 0.010, z - 0.006), (-0.030, _MIDDLE + 0.010, z + 0.006)
        shaper.box(boom, "scenery", low, high, "steel", f"cable_clip{number}")
    shaper.scenery(boom, "cable_loop", "black", _loop(), (_SIDE, _MIDDLE, _BACK))


def _loop() -> solids.Surface:
    """The loop, from the boom's side out and back to the end of the motor."""
    turns = np.linspace(0.0, math.pi, 13)
    way = [(0.007 * t - 0.06 * math.sin(t), 0.0, -0.06 * (1 - math.cos(t))) for t in turns]
    return solids.surface(solids.tube(way, 0.006))
