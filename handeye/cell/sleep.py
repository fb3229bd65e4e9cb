"""Sleep of what stands still: the simulator leaves it out until something touches it.

MuJoCo puts a tree of bodies to sleep once it, and all that it touches, has hardly moved for ten steps, and wakes it
when something awake comes into contact with it. It does not see that a motor is told something new: whoever drives one
wakes its tree.
"""

from typing import Final

import mujoco

_NUDGE: Final = 1e-12
"""rad/s, m/s: a velocity that is not zero wakes a tree."""
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
