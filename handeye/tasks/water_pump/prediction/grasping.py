"""Finding the base, and feeling for it: one finger into each of its large holes."""

from typing import Final

import numpy as np

from handeye.core.pose import Array, inverse, planar
from handeye.tasks.water_pump.prediction.assembly import Assembly
from handeye.tasks.water_pump.prediction.eye import seen_off
from handeye.tasks.water_pump.prediction.poses import moved, points
from handeye.tasks.water_pump.world.dimensions import base_top, dimensions

_WAYS: Final = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
_STEP: Final = 2e-4  # m: how finely the room of a finger is measured
_WALLS: Final = (("A", "DA", "1", "chamber"), ("B", "DB", "2", "inlet"))
"""Where the hand feels, what it saves, and the large hole and the casting on either side."""


def grasp(assembly: Assembly) -> None:
    """Look, and go to both walls that the hand feels for; the second is off as what was felt at the first leaves it."""
    true, seen, d = _lying(assembly), _seen(assembly), dimensions()
    part = assembly.program.parts["BASE"]
    planned = planar(*part.at)
    for goal, name, hole, wall in _WALLS:
        X_PT = inverse(planned) @ assembly.planned(goal)
        hand = moved(assembly.hands.at_each(seen @ X_PT, planned @ X_PT), assembly.shift(goal))
        off = points(true, X_PT[:3, 3]) - hand[:, :3, 3]
        line = true[:, :3, :3] @ X_PT[:3, 1]
        centre = (0.0, 0.0) if hole == "1" else (d("base.large_hole_2.x"), 0.0)
        middle = float(np.hypot(*(X_PT[:2, 3] - centre)))
        radius, outside = d(f"base.large_hole_{hole}.diameter") / 2, d(f"base.casting.{wall}_diameter") / 2
        room = _room(middle, assembly.ways[goal][0].gap, radius, outside)
        assembly.meets("grasp", goal, off, room)
        assembly.saved[name] = (off * line).sum(axis=1, keepdims=True) * line


def _lying(assembly: Assembly) -> Array:
    """Where the base lies on the belt."""
    x, y, yaw = (assembly.worlds[f"base.{way}"] for way in ("x", "y", "yaw"))
    return _planar(np.column_stack([x, y]), assembly.program.parts["BASE"].at[2], yaw)


def _seen(assembly: Assembly) -> Array:
    """Where it is found, as the arm reads; without vision, where it was planned."""
    part, true = assembly.program.parts["BASE"], _lying(assembly)
    if "vision" in assembly.without:
        return np.broadcast_to(planar(*part.at), true.shape).copy()
    holes = np.array([[hole.x, hole.y, base_top()] for hole in part.holes])
    planned = np.array([(planar(*part.at) @ [*hole, 1.0])[:3] for hole in holes])
    off = seen_off(assembly.worlds, assembly.hands, planned)
    apart = holes[1, 0] - holes[0, 0]
    turn = ((off[:, 1] - off[:, 0]) * true[:, :2, 1]).sum(axis=1) / apart
    yaw = assembly.worlds["base.yaw"] + turn
    middle = true[:, :2, 3] + true[:, :2, 0] * apart / 2 + off.mean(axis=1)
    return _planar(middle - np.column_stack([np.cos(yaw), np.sin(yaw)]) * apart / 2, part.at[2], yaw)


def _planar(xy: Array, z: float, yaw: Array) -> Array:
    """Poses of a part that stands upright, xy of shape (n, 2)."""
    X = np.zeros((len(xy), 4, 4))
    c, s = np.cos(yaw), np.sin(yaw)
    X[:, 0, 0], X[:, 0, 1], X[:, 1, 0], X[:, 1, 1] = c, -s, s, c
    X[:, 2, 2] = X[:, 3, 3] = 1.0
    X[:, :2, 3], X[:, 2, 3] = xy, z
    return X


def _room(middle: float, gap: float, hole: float, wall: float) -> float:
    """How far the hand may be off in any direction when one finger goes into a round hole and one beside its wall, m.

    Args:
        middle: of the hand, from the axis of the hole.
        gap: between the fingers.
        hole: radius.
        wall: radius outside.
    """
    d = dimensions()
    thick, half = d("hand.finger_thickness"), d("hand.finger_width") / 2
    inner = np.array([(x, middle - gap / 2 - t) for x in (-half, half) for t in (0.0, thick)])
    shifts = np.column_stack([np.cos(_WAYS), np.sin(_WAYS)])
    for r in np.arange(0.0, gap, _STEP):
        corners = inner + r * shifts[:, None]
        x, y = r * shifts[:, 0], middle + gap / 2 + r * shifts[:, 1]
        beside = np.hypot(np.maximum(np.abs(x) - half, 0.0), y)
        if np.hypot(*np.moveaxis(corners, -1, 0)).max() > hole or beside.min() < wall:
            return float(max(r - _STEP, 0.0))
    return gap
