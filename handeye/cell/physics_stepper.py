"""Steps of physics: none while all sleeps, long ones while nothing touches, short ones as soon as something does.

Short steps are for contact, whose softness grows with the square of a step. What moves freely needs none: with long
ones it has the same speeds, and is early by 1.6 ms, half of what a long step is longer. The brakes and the dry friction
of a joint are constraints, too: a joint that friction holds creeps at up to 9e-6 rad/s instead of 4e-6.

MuJoCo puts a tree of bodies to sleep once it, and all that it touches, has hardly moved for ten steps, and wakes it
when something awake touches it. It does not notice a new command to a motor: code that drives one must wake its tree.
"""

from typing import Final

import mujoco
import numpy as np

from handeye.core.errors import PhysicsFailed

LONGER: Final = 4
"""Short steps in a long one. Chosen: a servo period has a whole number of long ones, and friction holds."""


def check_physics(data: mujoco.MjData, fastest: float = np.inf) -> None:
    """Raise PhysicsFailed if the simulator has warned, or something moves faster (m/s, rad/s) than anything can."""
    warnings = data.warning.number
    if warnings.any():
        name = mujoco.mjtWarning(int(np.argmax(warnings != 0))).name
        raise PhysicsFailed(f"the simulated cell broke down ({name})")
    if not np.abs(data.qvel).max(initial=0.0) < fastest:  # nor is what is not a number
        raise PhysicsFailed(
            f"the simulated cell broke down (something moves faster than {fastest:g} m/s or rad/s)"
        )


class PhysicsStepper:
    """Lets the physics of a cell continue.

    A long step in which anything comes into contact is taken back, and short ones are made instead, from the last
    moment at which nothing touched: no contact ever feels a long step.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        self._model, self._data, self._short = model, data, float(model.opt.timestep)
        self._moves = (data.qpos, data.qvel, data.act, data.qacc_warmstart)
        self._kept = [values.copy() for values in self._moves]

    def step(self, steps: int) -> None:
        """Make `steps` short steps, or long ones over the same time."""
        if self._data.ncon or steps % LONGER or not self._freely(steps):
            self._closely(steps)

    def _closely(self, steps: int) -> None:
        """Make short steps, which a cell may want to watch."""
        mujoco.mj_step(self._model, self._data, steps)

    def _freely(self, steps: int) -> bool:
        """Make long steps; False if something came into contact, and none is made."""
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
    """Let a tree sleep though it has motors, or keep it from falling asleep."""
    model.tree_sleep_policy[tree] = _POLICY[allowed]


def wake(data: mujoco.MjData, dof: int) -> None:
    """Wake the tree that a degree of freedom belongs to, if it sleeps."""
    if data.qvel[dof] == 0.0:
        data.qvel[dof] = _NUDGE


def asleep(data: mujoco.MjData) -> bool:
    """True if everything sleeps and nothing has been done to wake any of it: then only time passes."""
    return data.ntree_awake == 0 and not (
        data.qvel.any() or data.qfrc_applied.any() or data.xfrc_applied.any()
    )
