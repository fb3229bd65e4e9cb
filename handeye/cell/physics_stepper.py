"""Steps of the physics: none while everything sleeps, long steps while nothing touches, and short steps while there are
contacts.

Contacts need short steps, because their softness grows with the square of the step. Free motion does not: with long
steps it has the same speeds, but is early by 1.6 ms, half of the difference between the two steps. Brakes and dry
friction of joints are constraints too. A joint held by friction creeps at up to 9e-6 rad/s with long steps, instead
of 4e-6 rad/s.

MuJoCo puts a tree of bodies to sleep when the tree, and everything it touches, has hardly moved for ten steps. It
wakes the tree when an awake body touches it, but not on a new command to a motor: code that drives a motor must
wake its tree.
"""

from typing import Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.core.errors import PhysicsFailed

LONGER: Final = 4
"""Number of short steps in a long step. Chosen so that a servo period is a whole number of long steps, and so that
friction holds.
"""


def check_physics(data: mujoco.MjData, fastest: float = np.inf) -> None:
    """Raise PhysicsFailed if the simulator has given a warning, or if a body moves faster than `fastest` (m/s,
    rad/s).
    """
    warnings = data.warning.number.tolist()
    if any(warnings):
        name = mujoco.mjtWarning(next(kind for kind, count in enumerate(warnings) if count)).name
        raise PhysicsFailed(f"the simulated cell broke down ({name})")
    if data.qvel @ data.qvel < fastest * fastest:  # then nothing is as fast as that; soon known
        return
    if not np.abs(data.qvel).max(initial=0.0) < fastest:  # nor is what is not a number
        raise PhysicsFailed(
            f"the simulated cell broke down (something moves faster than {fastest:g} m/s or rad/s)"
        )


class PhysicsStepper:
    """Advances the physics of a cell.

    If bodies come into contact during a long step, the steps are undone. Short steps are then made from the last
    moment without contacts, because contacts must begin in short steps.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data, self._short = model, data, float(model.opt.timestep)
        self._moves = (data.qpos, data.qvel, data.act, data.qacc_warmstart)
        self._kept = [values.copy() for values in self._moves]

    def step(self, steps: int) -> None:
        """Advance by `steps` short steps, or by long steps that cover the same time."""
        if self._data.ncon or steps % LONGER or not self._freely(steps):
            self._closely(steps)

    def _closely(self, steps: int) -> None:
        """Make short steps. A subclass may watch them."""
        mujoco.mj_step(self._model, self._data, steps)

    def _freely(self, steps: int) -> bool:
        """Make long steps. If a contact occurs, undo the steps and return False."""
        model, data = self._model, self._data
        began = data.time
        for kept, values in zip(self._kept, self._moves, strict=True):
            kept[:] = values
        model.opt.timestep = self._short * LONGER
        try:
            for _ in range(steps // LONGER):
                mujoco.mj_step(model, data)
                if data.ncon:  # where that step began
                    break
            else:
                mujoco.mj_kinematics(model, data)
                mujoco.mj_collision(model, data)
        finally:
            model.opt.timestep = self._short
        free = not data.ncon
        if not free:
            for kept, values in zip(self._kept, self._moves, strict=True):
                values[:] = kept
        data.time = began + steps * self._short if free else began
        return free


_NUDGE: Final = 1e-12  # rad/s, m/s: a velocity that is not zero wakes a tree
_POLICY: Final = {
    True: int(mujoco.mjtSleepPolicy.mjSLEEP_ALLOWED),
    False: int(mujoco.mjtSleepPolicy.mjSLEEP_NEVER),
}


def allow(model: mujoco.MjModel, tree: int, *, allowed: bool = True) -> None:
    """Allow a tree of bodies with motors to sleep, or keep it awake."""
    model.tree_sleep_policy[tree] = _POLICY[allowed]


def wake(data: mujoco.MjData, dof: int) -> None:
    """Wake the tree of bodies to which a degree of freedom belongs, if it sleeps."""
    if data.qvel[dof] == 0.0:
        data.qvel[dof] = _NUDGE


def wake_all(data: mujoco.MjData, dofs: NDArray[np.int_]) -> None:
    """Wake the trees of bodies to which degrees of freedom belong, if they sleep."""
    data.qvel[dofs[data.qvel[dofs] == 0.0]] = _NUDGE


def asleep(data: mujoco.MjData) -> bool:
    """Return True if everything sleeps and no body has been woken since, so that time can pass without computing."""
    return data.ntree_awake == 0 and not (
        data.qvel.any() or data.qfrc_applied.any() or data.xfrc_applied.any()
    )
