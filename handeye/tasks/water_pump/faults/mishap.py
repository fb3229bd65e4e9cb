"""Defines mishaps, and the scene in which they happen. A mishap is an event that happens once to the parts of a pump's
cell.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import mujoco
import numpy as np

from handeye.cell.physics_stepper import wake
from handeye.cell.threads import Threads
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.tasks.water_pump.faults.declaration import PumpFault
from handeye.tasks.water_pump.faults.scene_changes import GONE, OVER_TRAY_M

ON_BASE_M: Final = 0.15  # m, horizontally from the base's middle; a higher part within it stands on the base
_STACK: Final = ("gasket", "top", "pin0", "pin1")


class MishapState(Record, frozen=True, kw_only=True):
    """The state of a mishap: how long it has lasted, and whether it is over."""

    seconds: float | None = None  # since the mishap began; None: it has not begun
    place: tuple[float, float, float] | None = None
    """Position of the part (m) when the mishap began; None if the mishap concerns no part."""
    over: bool = False  # it has happened


@dataclass(frozen=True, slots=True)
class Scene:
    """The scene of a cell, in which a mishap can move parts."""

    model: mujoco.MjModel
    data: mujoco.MjData
    threads: Threads | None = None  # the threads of the cell, during a run

    def dofs(self, part: str) -> slice:
        """Return the indices of a free part's degrees of freedom."""
        start = int(self.model.body_dofadr[self.model.body(part).id])
        return slice(start, start + 6)

    def place(self, part: str) -> Array:
        """Return the position of a free part (m) as a view of the simulator's own array: writing to the view
        moves the part."""
        start = int(self.model.jnt_qposadr[self.model.body_jntadr[self.model.body(part).id]])
        return np.asarray(self.data.qpos[start : start + 3])

    def shift(self, part: str, way: Array) -> None:
        """Move a free part by `way` (m) and bring it to rest."""
        self.place(part)[:] += way
        self.data.qvel[self.dofs(part)] = 0.0
        wake(self.data, self.dofs(part).start)

    def stack(self) -> list[str]:
        """Return the names of the base and of the parts on it."""
        (x, y, z), parts = self.place("base"), ["base"]
        for part in _STACK:
            aside, high = self.place(part)[:2] - (x, y), self.place(part)[2] - z
            if np.hypot(*aside) < ON_BASE_M and high >= 0:
                parts.append(part)
        return parts

    def take(self, part: str) -> None:
        """Take a part away by putting it on the tray."""
        self.shift(part, self.to_tray(part))

    def to_tray(self, part: str) -> Array:
        """Return the displacement of a part from its present position to its place on the tray (m, shape (3,))."""
        (x, y), tray = GONE[part], self.model.geom("tray").id
        return np.array([x, y, self.data.geom_xpos[tray][2] + OVER_TRAY_M]) - self.place(part)


@dataclass(frozen=True, slots=True)
class Mishap:
    """An event that happens once. `act` is called in every physics tick, and returns True when the event is
    over."""

    act: Callable[[Scene, MishapState], bool]
    watched: str | None = None  # the part whose position must be known when the mishap begins, if any


MishapFault = PumpFault[Callable[[float], Mishap]]


def always(mishap: Mishap) -> Callable[[float], Mishap]:
    """Return a function that returns `mishap` for every size. It is used to declare faults without a size."""
    return lambda _: mishap
