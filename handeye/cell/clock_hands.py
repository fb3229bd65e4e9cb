"""Bodies of a scene that no run moves: they stand as drawn, and the hands of a clock turn with the cell's clock."""

from collections.abc import Iterable
from typing import Any, Final

import mujoco
import numpy as np

from handeye.core.pose import Array

TURNS: Final = "turns/"
"""Begins the names of the figures in which a scene tells in how many seconds a body of the world turns once."""


def hand_poses(model: mujoco.MjModel, time: float) -> dict[str, Array]:
    """Poses of the hands at a time of the cell's clock, by the names of their bodies: as `drawn_poses`."""
    return {name: rows[0] for name, rows in drawn_poses(model, _turns(model), np.array([time])).items()}


def drawn_poses(model: mujoco.MjModel, names: Iterable[str], times: Array) -> dict[str, Array]:
    """Poses in W of bodies fixed in the world, at times of the cell's clock (s), by their names, shape (n, 7) each.

    A pose is a place (m), then a unit quaternion w, x, y, z. Hands turn clockwise about their z axis, and stand at
    twelve when the clock does at 0.
    """
    turns = _turns(model)
    return {name: _turned(model, name, times * turns.get(name, 0.0)) for name in names}


def _turns(model: mujoco.MjModel) -> dict[str, float]:
    """Turns in a second, by the names of the bodies that turn."""
    told: list[Any] = [model.numeric(number) for number in range(model.nnumeric)]
    hands = [figure for figure in told if figure.name.startswith(TURNS)]
    return {figure.name.removeprefix(TURNS): 1 / float(figure.data[0]) for figure in hands}


def _turned(model: mujoco.MjModel, name: str, turns: Array) -> Array:
    body, half = model.body(name), -np.pi * turns
    w, x, y, z = body.quat
    c, s = np.cos(half), np.sin(half)
    turned = [w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s]
    return np.column_stack([np.tile(body.pos, (len(turns), 1)), *turned])
