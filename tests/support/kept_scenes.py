"""Scenes of the pump's worlds, compiled once in a process: each cell of a world gets a copy of its own."""

from __future__ import annotations

import pickle
import sys
from collections.abc import Callable
from copy import copy
from functools import wraps
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco

    from handeye.tasks.water_pump.world.pump_world import PumpWorld

CELL = "handeye.tasks.water_pump.cell"
MOST = 8
"""Scenes kept at a time: those of the worlds that a file of tests uses again and again."""

Build = Callable[["PumpWorld"], "mujoco.MjModel"]


def keep_scenes() -> None:
    """Have cells built from kept scenes, if the tests that were collected build any in this process.

    `test_kept_scenes.py` shows that a copy equals what is compiled anew.
    """
    cell = sys.modules.get(CELL)
    if cell is not None and not hasattr(cell.build, "__wrapped__"):
        cell.build = keeping(cell.build)


def keeping(build: Build) -> Build:
    """The same, compiling only worlds that are not among the last ones."""
    kept: dict[bytes, mujoco.MjModel] = {}

    @wraps(build)
    def built(world: PumpWorld) -> mujoco.MjModel:
        key = pickle.dumps(world)
        kept[key] = kept.pop(key, None) or build(world)
        if len(kept) > MOST:
            del kept[next(iter(kept))]
        return copy(kept[key])

    return built
