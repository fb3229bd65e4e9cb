"""The true state of a simulated cell. Only the referee, the trace and tests may use the true state; the program and
the controller must not.
"""

import copy
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import msgspec
import mujoco
import numpy as np

from handeye.cell.mechanism import Mechanism


@dataclass(frozen=True, slots=True, kw_only=True)
class Truth:
    """The live state of the simulator, which must not be changed."""

    model: mujoco.MjModel
    data: mujoco.MjData
    drawn: mujoco.MjModel
    """The scene in its initial state."""
    states: Mapping[str, msgspec.Struct]
    """States of the mechanisms of the cell, by name, at the time when the truth was requested."""
    mechanisms: tuple[Mechanism[Any], ...]

    def copy(self) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """Copy the state for experiments. In the copy all bodies are awake, and the shortcuts that make the simulation
        faster are off.
        """
        kind = int(mujoco.mjtState.mjSTATE_INTEGRATION)
        state = np.empty(mujoco.mj_stateSize(self.model, kind))
        mujoco.mj_getState(self.model, self.data, state, kind)
        model = copy.deepcopy(self.model)
        model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
        data = mujoco.MjData(model)
        mujoco.mj_setState(model, data, state, kind)
        for mechanism in self.mechanisms:
            mechanism.release(model, data)
        mujoco.mj_forward(model, data)
        return model, data
