"""Tape of all that a cell does to its simulator, and the same done again with nothing else: bare physics.

Between two calls of the simulator a cell writes controls, forces, figures of the model and, now and then, positions.
The tape has what was written before each call, and the call. A stretch of it begins where the simulator is reset, which
is between two steps of a program, so that each can be compared by itself with what the run came to.
"""

import copy
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from types import EllipsisType
from typing import Any, Final, Protocol

import mujoco
import numpy as np

from handeye.cell.simulated import INTEGRATION, SimulatedCell

_CALLS: Final = ("mj_step", "mj_step1", "mj_step2", "mj_forward", "mj_resetData")
"""All by which a cell has its simulator work out anything that lasts."""
_RESET: Final = "mj_resetData"
_STATE: Final = (
    "qpos", "qvel", "act", "history", "qacc_warmstart", "ctrl", "qfrc_applied", "xfrc_applied", "eq_active",
    "mocap_pos", "mocap_quat", "userdata",
)  # fmt: skip
"""The integration state, by the names of its arrays; the clock is the rest of it."""
_FIGURES: Final = ("actuator_trnid",)
"""Figures of the model that a cell changes and keeps in the state of a mechanism, beside those kept as figures."""

Call = Callable[..., Any]
_Written = tuple[str, Any]
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


class _Place(Protocol):
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
class _Move:
    """A call of the simulator, and what was written before it."""

    call: str
    arguments: tuple[Any, ...]
    written: tuple[_Written, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Stretch:
    """Calls from one reset on, and the state they have led to."""

    moves: Sequence[_Move]
    left: tuple[_Written, ...]
    """Written after the last call: the clock, if everything sleeps then."""
    end: bytes
    end_s: float
    """The cell's clock then."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Bare:
    """What a tape came to when it was played."""

    seconds: float
    """By the clock that was given."""
    physics_steps: int
    stretches: int
    same: int
    """Stretches that ended in the state of the run, bit for bit."""
    apart_s: float | None
    """The cell's clock at the end of the first that did not."""


class Tape:
    """What is done to the simulator of one cell."""

    def __init__(self, cell: SimulatedCell) -> None:
        """An empty tape; the cell is at the beginning of what will be recorded."""
        truth = cell.truth
        self._cell, self._data = cell, truth.data
        self._model = copy.deepcopy(truth.model)
        self._figures = (*cell.capture().figures, *_FIGURES)
        self._places = _places(truth.model, truth.data, self._figures)
        self._before: dict[str, bytes] = {}
        self._moves: list[_Move] = []
        self._stretches: list[_Stretch] = []

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
            self._moves.append(_Move(call.__name__, arguments, tuple(self._written())))
            result = call(model, data, *arguments)
            self._before = {name: place[...].tobytes() for name, place in self._places.items()}
            return result

        return through

    def _written(self) -> Iterator[_Written]:
        for name, place in self._places.items():
            if place[...].tobytes() != self._before.get(name):
                yield name, np.array(place[...])

    def _cut(self) -> None:
        """End a stretch."""
        if self._moves:
            end = _state(self._cell.truth.model, self._data)
            left = tuple(self._written())
            self._stretches.append(_Stretch(moves=self._moves, left=left, end=end, end_s=self._cell.now))
        self._moves = []

    def play(self, clock: Callable[[], float]) -> Bare:
        """Do all of it again in a simulator of its own, and take the time of that."""
        model = copy.deepcopy(self._model)
        data = mujoco.MjData(model)
        places = _places(model, data, self._figures)
        seconds, apart = 0.0, []
        for stretch in self._stretches:
            moves = [_ready(move, places) for move in stretch.moves]
            begun = clock()
            for call, arguments, written in moves:
                for place, values in written:
                    place[...] = values
                call(model, data, *arguments)
            seconds += clock() - begun
            for name, values in stretch.left:
                places[name][...] = values
            if _state(model, data) != stretch.end:
                apart.append(stretch.end_s)
        return Bare(
            seconds=seconds,
            physics_steps=sum(_steps(move) for stretch in self._stretches for move in stretch.moves),
            stretches=len(self._stretches),
            same=len(self._stretches) - len(apart),
            apart_s=apart[0] if apart else None,
        )


def _places(model: mujoco.MjModel, data: mujoco.MjData, figures: Sequence[str]) -> dict[str, _Place]:
    return {
        "data.time": _Number(data, "time"),
        "model.opt.timestep": _Number(model.opt, "timestep"),
        **{f"data.{name}": getattr(data, name) for name in _STATE},
        **{f"model.{name}": getattr(model, name) for name in figures},
    }


def _ready(move: _Move, places: dict[str, _Place]) -> tuple[Call, tuple[Any, ...], list[tuple[_Place, Any]]]:
    return (
        getattr(mujoco, move.call),
        move.arguments,
        [(places[name], values) for name, values in move.written],
    )


def _steps(move: _Move) -> int:
    if move.call not in ("mj_step", "mj_step2"):
        return 0
    return int(move.arguments[0]) if move.arguments else 1


def _state(model: mujoco.MjModel, data: mujoco.MjData) -> bytes:
    state = np.empty(mujoco.mj_stateSize(model, INTEGRATION))
    mujoco.mj_getState(model, data, state, INTEGRATION)
    return state.tobytes()
