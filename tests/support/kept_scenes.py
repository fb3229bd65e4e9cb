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
"""Greatest number of kept scenes: enough for the worlds that a file of tests uses again and again."""

Build = Callable[["PumpWorld"], "mujoco.MjModel"]


def keep_scenes() -> None:
    """Build cells from kept scenes, if the collected tests build cells in this process. `test_kept_scenes.py` shows
    that a copy equals a newly compiled scene.
    """
    cell = sys.modules.get(CELL)
    if cell is not None and not hasattr(cell.build, "__wrapped__"):
        cell.build = keeping(cell.build)


def keeping(build: Build) -> Build:
    """Return the same function, which compiles a scene only if its world is not among the last ones."""
    kept: dict[bytes, mujoco.MjModel] = {}

    @wraps(build)
    def built(world: PumpWorld) -> mujoco.MjModel:
        key = pickle.dumps(world)
        kept[key] = kept.pop(key, None) or build(world)
        if len(kept) > MOST:
            del kept[next(iter(kept))]
        return copy(kept[key])

    return built
