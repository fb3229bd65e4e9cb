"""Tape of all that a cell does to its simulator, and the same done again with nothing else: bare physics.

Between two calls of the simulator a cell writes controls, forces, figures of the model and, now and then, positions.
The tape has what was written before each call, and the call. A stretch of it begins where the simulator is reset, which
is between two steps of a program, so that each can be compared by itself with the run.
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
"""All by which a cell has its simulator work out anything that lasts."""
_RESET: Final = "mj_resetData"
_STATE: Final = (
    "qpos", "qvel", "act", "history", "qacc_warmstart", "ctrl", "qfrc_applied", "xfrc_applied", "eq_active",
    "mocap_pos", "mocap_quat", "userdata",
)  # fmt: skip
"""The integration state, by the names of its arrays; the clock is the rest of it."""
_FIGURES: Final = ("actuator_trnid", "geom_solimp")
"""Figures of the model that a cell changes, beside those kept as figures in its state: kept by a mechanism, or changed
for some steps only."""

Call = Callable[..., Any]
Written = tuple[str, Any]
"""Name of a place, and what was written there."""


@contextmanager
def physics_through(through: Callable[[Call], Call]) -> Iterator[None]:
    """While entered, every call of the simulator goes through what is made of it.

    The simulator is a module of functions, which cells call by name: there is nothing to hand in.
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
    """Somewhere in the simulator that can be read and written as a whole."""

    def __getitem__(self, whole: EllipsisType, /) -> Any: ...
    def __setitem__(self, whole: EllipsisType, values: Any, /) -> None: ...


@dataclass(frozen=True, slots=True)
class _Number:
    """A place that is a number."""

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
    """Calls from one reset on, and the state they have led to."""

    moves: Sequence[Move]
    left: tuple[Written, ...]
    """Written after the last call: the clock, if everything sleeps then."""
    end: bytes
    end_s: float
    """The cell's clock then."""


class Tape:
    """What is done to the simulator of one cell."""

    def __init__(self, cell: SimulatedCell) -> None:
        """An empty tape; the cell is at the beginning of what will be recorded."""
        truth = cell.truth
        self.model = copy.deepcopy(truth.model)
        """The model at the beginning."""
        self.figures = (*cell.capture().figures, *_FIGURES)
        """Fields of the model that are watched."""
        self.stretches: list[Stretch] = []
        self._cell, self._data = cell, truth.data
        self._places = places(truth.model, truth.data, self.figures)
        self._before: dict[str, bytes] = {}
        self._figured: dict[
            bytes, Any
        ] = {}  # figures of shapes: they are many, and return to the same values
        self._moves: list[Move] = []

    @contextmanager
    def recording(self) -> Iterator[None]:
        """Record while entered. The cell is put into its own state first, as it is between two steps of a program."""
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
    """All places that are watched, by their names."""
    return {
        "data.time": _Number(data, "time"),
        "model.opt.timestep": _Number(model.opt, "timestep"),
        **{f"data.{name}": getattr(data, name) for name in _STATE},
        **{f"model.{name}": getattr(model, name) for name in figures},
    }


def state_of(model: mujoco.MjModel, data: mujoco.MjData) -> bytes:
    """The integration state, bit for bit."""
    state = np.empty(mujoco.mj_stateSize(model, INTEGRATION))
    mujoco.mj_getState(model, data, state, INTEGRATION)
    return state.tobytes()
