"""Records on a tape everything that a cell writes to its simulator, so that the physics can be replayed alone.

Between two calls of the simulator, a cell writes controls, forces, properties of the model, and sometimes positions.
The tape contains each call, and what was written before it. A stretch of the tape begins when the simulator is reset,
which happens between two steps of a program. Each stretch can therefore be compared separately with the run.
"""

import copy
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from types import EllipsisType
from typing import Any, Final, Protocol

import mujoco
import numpy as np

from handeye.cell.simulated import SimulatedCell
from handeye.cell.snapshot_cell import INTEGRATION

_CALLS: Final = ("mj_step", "mj_step1", "mj_step2", "mj_forward", "mj_resetData")
"""All functions of the simulator with which a cell changes the simulator's state."""
_RESET: Final = "mj_resetData"
_STATE: Final = (
    "qpos", "qvel", "act", "history", "qacc_warmstart", "ctrl", "qfrc_applied", "xfrc_applied", "eq_active",
    "mocap_pos", "mocap_quat", "userdata", "tree_asleep",
)  # fmt: skip
"""The arrays of the integration state, by name, and which bodies sleep. Apart from them, the integration state contains
only the clock.
"""
_FIGURES: Final = ("actuator_trnid", "geom_solimp", "eq_solimp")
"""Fields of the model that a cell changes, in addition to those in the cell's own state. They belong to a mechanism, or
are changed for a few steps only.
"""

Call = Callable[..., Any]
Written = tuple[str, Any]
"""Name of a place, and the values written there."""


@contextmanager
def physics_through(through: Callable[[Call], Call]) -> Iterator[None]:
    """Within this context, `through` wraps every function of the simulator that is in `_CALLS`.

    The functions are replaced in the module `mujoco`, because cells call them there by name.
    """
    own = {name: getattr(mujoco, name) for name in _CALLS}
    for name, call in own.items():
        setattr(mujoco, name, through(call))
    try:
        yield
    finally:
        for name, call in own.items():
            setattr(mujoco, name, call)


class Place(Protocol):
    """An array or number of the simulator that can be read and written as a whole."""

    def __getitem__(self, whole: EllipsisType, /) -> Any: ...
    def __setitem__(self, whole: EllipsisType, values: Any, /) -> None: ...


@dataclass(frozen=True, slots=True)
class _Number:
    """A place that contains one number."""

    owner: Any
    name: str

    def __getitem__(self, whole: EllipsisType, /) -> Any:
        return np.float64(getattr(self.owner, self.name))

    def __setitem__(self, whole: EllipsisType, value: Any, /) -> None:
        setattr(self.owner, self.name, float(value))


@dataclass(frozen=True, slots=True)
class Move:
    """A call of the simulator, and what was written before it."""

    call: str
    arguments: tuple[Any, ...]
    written: tuple[Written, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Stretch:
    """The calls from one reset to the next, and the state at the end."""

    moves: Sequence[Move]
    left: tuple[Written, ...]
    """Values written after the last call, such as the clock if all bodies sleep."""
    end: bytes
    end_s: float
    """The cell's clock at the end (s)."""


class Tape:
    """Everything that is written to the simulator of one cell."""

    def __init__(self, cell: SimulatedCell) -> None:
        """Make an empty tape. The cell must be in the state in which the recording will begin."""
        truth = cell.truth
        self.model = copy.deepcopy(truth.model)
        """The model at the beginning of the recording."""
        self.figures = (*cell.capture().figures, *_FIGURES)
        """Fields of the model that are watched."""
        self.stretches: list[Stretch] = []
        self._cell, self._data = cell, truth.data
        self._places = places(truth.model, truth.data, self.figures)
        self._before: dict[str, bytes] = {}
        self._figured: dict[
            bytes, Any
        ] = {}  # values of shapes, each stored once: they are large, and often repeat
        self._moves: list[Move] = []

    @contextmanager
    def recording(self) -> Iterator[None]:
        """Record within this context. First the state of the cell is captured and restored, as between two steps of a
        program.
        """
        with physics_through(self._recorded):
            self._cell.restore(self._cell.capture())
            yield
            self._cut()

    def _recorded(self, call: Call) -> Call:
        def through(model: mujoco.MjModel, data: mujoco.MjData, *arguments: Any) -> Any:
            if data is not self._data:
                return call(model, data, *arguments)
            if call.__name__ == _RESET:
                self._cut()
            self._moves.append(Move(call.__name__, arguments, tuple(self._written())))
            result = call(model, data, *arguments)
            self._before = {name: place[...].tobytes() for name, place in self._places.items()}
            return result

        return through

    def _written(self) -> Iterator[Written]:
        for name, place in self._places.items():
            now = place[...].tobytes()
            if now != self._before.get(name):
                values = np.array(place[...])
                yield name, self._figured.setdefault(now, values) if name.startswith("model.geom") else values

    def _cut(self) -> None:
        """End a stretch."""
        if self._moves:
            end = state_of(self._cell.truth.model, self._data)
            left = tuple(self._written())
            self.stretches.append(Stretch(moves=self._moves, left=left, end=end, end_s=self._cell.now))
        self._moves = []


def places(model: mujoco.MjModel, data: mujoco.MjData, figures: Sequence[str]) -> dict[str, Place]:
    """Return all places that are watched, by name."""
    return {
        "data.time": _Number(data, "time"),
        "model.opt.timestep": _Number(model.opt, "timestep"),
        **{f"data.{name}": getattr(data, name) for name in _STATE},
        **{f"model.{name}": getattr(model, name) for name in figures},
    }


def state_of(model: mujoco.MjModel, data: mujoco.MjData) -> bytes:
    """Return the bytes of the integration state."""
    state = np.empty(mujoco.mj_stateSize(model, INTEGRATION))
    mujoco.mj_getState(model, data, state, INTEGRATION)
    return state.tobytes()
