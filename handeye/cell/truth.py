"""What is really so in a simulated cell: for the referee, the trace and tests, never for the working phase."""

import copy
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.tasks.water_pump.clamping import Resting
from handeye.tasks.water_pump.threads import Thread


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawn:
    """How a scene was drawn, before anything happened in it."""

    groups: NDArray[np.int32]
    """Of the shapes."""
    colours: NDArray[np.float32]
    """Of the materials: red, green, blue, alpha, shape (n, 4)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Truth:
    """The simulator's state. It is the live one: look, do not touch."""

    model: mujoco.MjModel
    data: mujoco.MjData
    drawn: Drawn
    threads: tuple[Thread, ...]
    """The tapped holes of the base, in the order of the carriers."""
    resting: Resting

    def copy(self) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """A copy of the state to experiment with: all awake, nothing welded."""
        kind = int(mujoco.mjtState.mjSTATE_INTEGRATION)
        state = np.empty(mujoco.mj_stateSize(self.model, kind))
        mujoco.mj_getState(self.model, self.data, state, kind)
        model = copy.deepcopy(self.model)
        model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        data = mujoco.MjData(model)
        mujoco.mj_setState(model, data, state, kind)
        self.resting.part(model, data)
        mujoco.mj_forward(model, data)
        return model, data
