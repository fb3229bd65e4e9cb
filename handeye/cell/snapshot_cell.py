"""A cell whose state can be saved and restored. The cell consists of a MuJoCo model, and of mechanisms with states."""

import copy
from collections.abc import Sequence
from typing import Any, Final

import msgspec
import mujoco
import numpy as np

from handeye.cell.mechanism import Mechanism
from handeye.cell.state import CellState, check_noise, noise_state, set_noise
from handeye.cell.truth import Truth
from handeye.core.errors import BadFile, InvalidInput
from handeye.ports.camera import Renderer

INTEGRATION: Final = int(mujoco.mjtState.mjSTATE_INTEGRATION)
"""MuJoCo's integration state, which suffices to continue a simulation."""


class SnapshotCell:
    """A cell for runs of any system. The state of the cell can be saved, restored and viewed."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        mechanisms: Sequence[Mechanism[Any]],
        noise: np.random.Generator,
    ) -> None:
        """Build a cell from a scene and mechanisms. The caller must not change the scene later. The names of the
        mechanisms must differ. The mechanisms act in the given order.
        """
        self._model, self._data, self._noise = model, data, noise
        self._drawn = copy.deepcopy(model)
        self._mechanisms = tuple(mechanisms)
        names = [part.name for part in self._mechanisms]
        if len({*names}) < len(names):
            raise ValueError(
                f"devices and mechanisms of a cell need different names; the given names are {', '.join(names)}"
            )
        self._changes = sorted({field for part in self._mechanisms for field in part.changes})

    @property
    def truth(self) -> Truth:
        """The true state of the cell, for the referee, the trace and tests only."""
        return Truth(
            model=self._model,
            data=self._data,
            drawn=self._drawn,
            states={part.name: part.state() for part in self._mechanisms},
            mechanisms=self._mechanisms,
        )

    @property
    def renderer(self) -> Renderer:
        """The renderer of the cell's camera. The renderer's method is `none` if the cell has no camera."""
        return Renderer(method="none")

    def capture(self) -> CellState:
        """Return the complete state of the cell, which `restore` can restore in this cell or in an equal one."""
        physics = np.empty(mujoco.mj_stateSize(self._model, INTEGRATION))
        mujoco.mj_getState(self._model, self._data, physics, INTEGRATION)
        return CellState(
            physics=physics,
            figures={name: np.array(getattr(self._model, name), dtype=float) for name in self._changes},
            noise=noise_state(self._noise),
            mechanisms={part.name: msgspec.to_builtins(part.state()) for part in self._mechanisms},
        )

    def restore(self, state: CellState) -> None:
        """Restore the cell to a state. Whatever the cell did before, it takes the same course from this state on, byte
        for byte.

        Sleep is not part of a state: when a state is restored, all bodies wake, and then the bodies at rest fall
        asleep again. An interrupted run must give the same results as an uninterrupted run. Therefore, the cell
        restores its own state at every point where the run might be interrupted. Raises InvalidInput if the state
        belongs to another kind of cell or is not valid.
        """
        try:
            self._check(state)
            states = [msgspec.convert(state.mechanisms[part.name], part.kind) for part in self._mechanisms]
            for part, own in zip(self._mechanisms, states, strict=True):
                part.check(own)
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError, InvalidInput) as error:
            raise BadFile(f"this is not a state of this work cell: {error}") from None
        model, data = self._model, self._data
        set_noise(self._noise, state.noise)
        for name, values in state.figures.items():
            getattr(model, name)[:] = values
        for part, own in zip(self._mechanisms, states, strict=True):
            part.restore(own)
        mujoco.mj_resetData(model, data)
        mujoco.mj_setState(model, data, state.physics, INTEGRATION)
        mujoco.mj_forward(model, data)
        mujoco.mj_setState(model, data, state.physics, INTEGRATION)  # what the solver starts from, too

    def _check(self, state: CellState) -> None:
        """Raise ValueError unless the values of a state are valid and fit this cell."""
        if state.physics.shape != (mujoco.mj_stateSize(self._model, INTEGRATION),):
            raise ValueError("the saved physics belong to another scene")
        if set(state.figures) != set(self._changes):
            raise ValueError(
                "the fields of the model that change in the scene of the saved state are not those that change in "
                "this scene"
            )
        for name, values in state.figures.items():
            if values.shape != getattr(self._model, name).shape:
                raise ValueError(f"{name} has a different size here")
        if not all(np.isfinite(values).all() for values in (state.physics, *state.figures.values())):
            raise ValueError("some saved values are not finite numbers")
        if not 0 <= state.time < 1e9:
            raise ValueError("the saved clock shows an impossible time")
        if set(state.mechanisms) != {part.name for part in self._mechanisms}:
            raise ValueError("the saved state belongs to a cell with other devices or mechanisms")
        check_noise(state.noise)
