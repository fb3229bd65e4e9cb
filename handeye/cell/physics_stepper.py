"""Steps of the physics: none while everything sleeps, long steps while only carried parts touch other bodies, and
short steps while there are any other contacts.

Contacts need short steps, because their softness grows with the square of the step. Free motion does not: with long
steps it has the same speeds, but is early by 1.6 ms, half of the difference between the two steps. Brakes and dry
friction of joints are constraints too. A joint held by friction creeps at up to 9e-6 rad/s with long steps, instead
of 4e-6 rad/s.

A part that is carried through the air touches only the bodies that hold it. Steps with these contacts may be long
too, if the task names the pair of bodies. In long steps these contacts are made stiffer, so that a part sinks as
deep into the fingers as in short steps. Contacts may neither begin nor end in long steps. If a finger that presses
with 80 N lost its contact with the part in a long step, the finger would move 1.5 mm into the part before the next
step detected the contact, and would throw the part away.

Euler's method moves the joints, and with them the hand, along an arc, but a free body along the tangent. It leaves
out the second-order term of the motion: half the acceleration times the square of the step. After long steps this
term is therefore added to carried bodies; it is a few micrometres in a servo period. The term does not
hold a part in the fingers; friction alone does, and a part that slips goes on slipping. With the term, a held part
creeps less than in short steps, which leave it out.

MuJoCo puts a tree of bodies to sleep when the tree, and everything it touches, has hardly moved for ten steps. It
wakes the tree when an awake body touches it, but not on a new command to a motor: code that drives a motor must
wake its tree.
"""

from dataclasses import dataclass
from typing import Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.core.errors import PhysicsFailed

LONGER: Final = 4
"""Number of short steps in a long step. Chosen so that a servo period is a whole number of long steps, and so that
friction holds.
"""
STIFFER: Final = LONGER**2
"""Factor by which the contacts of carried parts are stiffer in long steps. It makes up for the length of the step."""
BodyPairs = frozenset[tuple[int, int]]  # numbers of bodies, the smaller first


@dataclass(frozen=True, slots=True, kw_only=True)
class Carrying:
    """The contacts that are allowed in long steps, because one body carries the other. Bodies are given by name."""

    hand: str  # the body that moves everything that is carried
    pairs: tuple[tuple[str, str], ...]  # the hand and a free body, or two free bodies


def check_physics(data: mujoco.MjData, fastest: float = np.inf) -> None:
    """Raise PhysicsFailed if the simulator has given a warning, or if a body moves faster than `fastest` (m/s,
    rad/s).
    """
    warnings = data.warning.number.tolist()
    if any(warnings):
        name = mujoco.mjtWarning(next(kind for kind, count in enumerate(warnings) if count)).name
        raise PhysicsFailed(f"the simulated cell broke down ({name})")
    if data.qvel @ data.qvel < fastest * fastest:  # a quick test: then no single rate is as fast
        return
    if not np.abs(data.qvel).max(initial=0.0) < fastest:  # also true for NaN
        raise PhysicsFailed(
            f"the simulated cell broke down (something moves faster than {fastest:g} m/s or rad/s)"
        )


class PhysicsStepper:
    """Advances the physics of a cell.

    If a contact begins or ends during a long step, the long steps of this period are undone, and short steps are
    made from the last moment before it.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, carrying: Carrying | None = None) -> None:
        """`carrying` gives the contacts that are allowed in long steps. By default no contacts are allowed."""
        self._model, self._data, self._short = model, data, float(model.opt.timestep)
        self._moves = (data.qpos, data.qvel, data.act, data.qacc_warmstart)
        self._kept = [values.copy() for values in self._moves]
        self._hand = 0 if carrying is None else model.body(carrying.hand).id
        self._carried = np.zeros(
            (model.ntree + 1, model.ntree + 1), dtype=bool
        )  # the last is for bodies fixed in the world
        for pair in () if carrying is None else carrying.pairs:
            first, second = (model.body_treeid[model.body(name).id] for name in pair)
            self._carried[first, second] = self._carried[second, first] = True
        roots = [(int(body), int(model.body_jntadr[body])) for body in model.tree_bodyadr]
        self._free = [(body, int(model.jnt_qposadr[joint])) for body, joint in roots]  # of each tree
        self._seen, self._pairs, self._only_carried = b"", BodyPairs(), True
        self._bends = np.zeros((2, 3, model.nv))
        self._soft = model.geom_solimp.copy()
        self._stiff = self._soft.copy()
        impedance = self._stiff[:, :2]  # a contact's stiffness is proportional to d / (1 - d)
        impedance *= STIFFER / (1.0 + (STIFFER - 1.0) * impedance)

    def step(self, steps: int) -> None:
        """Advance by `steps` short steps, or by long steps that cover the same time."""
        if steps % LONGER or not self._carrying() or not self._smoothly(steps):
            self._closely(steps)

    def _closely(self, steps: int) -> None:
        """Make short steps. A subclass may watch them."""
        mujoco.mj_step(self._model, self._data, steps)

    def _touching(self) -> BodyPairs:
        """Return the pairs of bodies that touch."""
        geoms = self._data.contact.geom
        seen = geoms.tobytes()
        if seen != self._seen:  # they seldom change from one step to the next
            model = self._model
            bodies = np.sort(model.geom_bodyid[geoms], axis=1)
            first, second = model.body_treeid[bodies].T
            self._seen, self._only_carried = seen, bool(self._carried[first, second].all())
            self._pairs = frozenset((int(one), int(other)) for one, other in bodies)
        return self._pairs

    def _carrying(self) -> bool:
        """Return True if no parts except carried parts have contacts."""
        self._touching()
        return self._only_carried

    def _smoothly(self, steps: int) -> bool:
        """Make long steps. If a contact begins or ends, undo them and return False."""
        model, data = self._model, self._data
        began, touching = data.time, self._touching()
        for kept, values in zip(self._kept, self._moves, strict=True):
            kept[:] = values
        model.opt.timestep = self._short * LONGER
        if touching:
            model.geom_solimp[:] = self._stiff
        smooth = True
        try:
            for _ in range(steps // LONGER):
                mujoco.mj_step(model, data)  # its contacts are those at its beginning
                smooth = self._touching() == touching
                if not smooth:
                    break
            else:
                mujoco.mj_kinematics(model, data)
                mujoco.mj_collision(model, data)
                smooth = self._touching() == touching
        finally:
            model.opt.timestep = self._short
            if touching:
                model.geom_solimp[:] = self._soft
        if not smooth:
            for kept, values in zip(self._kept, self._moves, strict=True):
                values[:] = kept
        elif touching:
            self._add_second_order(steps)
        data.time = began + steps * self._short if smooth else began
        return smooth

    def _held(self) -> set[int]:
        """Return the trees of bodies that the hand carries, directly or by way of other carried bodies."""
        pairs = [{int(self._model.body_treeid[body]) for body in pair} for pair in self._touching()]
        reached, before = {int(self._model.body_treeid[self._hand])}, 0
        while len(reached) > before:
            before = len(reached)
            reached = reached.union(*(pair for pair in pairs if reached & pair))
        return reached - {int(self._model.body_treeid[self._hand])}

    def _add_second_order(self, steps: int) -> None:
        """Add to the carried bodies the second-order term that Euler's method leaves out when the hand moves along
        an arc: half the velocity-dependent acceleration, times the square of the long step. The long steps cover
        the time of `steps` short steps.
        """
        model, data = self._model, self._data
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        late = LONGER * self._short * steps * self._short / 2.0  # s2: half a step, over all of them
        for tree in sorted(self._held()):
            body, start = self._free[tree]
            mujoco.mj_jacDot(model, data, self._bends[0], self._bends[1], data.xpos[body], self._hand)
            way, turn = late * (self._bends @ data.qvel)
            data.qpos[start : start + 3] += way
            along = data.xmat[body].reshape(3, 3).T @ turn  # quaternions turn about a body's own axes
            mujoco.mju_quatIntegrate(data.qpos[start + 3 : start + 7], along, 1.0)


_NUDGE: Final = 1e-12  # in rad/s or m/s: a velocity that is not zero wakes a tree
_POLICY: Final = {
    True: int(mujoco.mjtSleepPolicy.mjSLEEP_ALLOWED),
    False: int(mujoco.mjtSleepPolicy.mjSLEEP_NEVER),
}


def allow(model: mujoco.MjModel, tree: int, *, allowed: bool = True) -> None:
    """Allow a tree of bodies with motors to sleep, or keep it awake."""
    model.tree_sleep_policy[tree] = _POLICY[allowed]


def wake(data: mujoco.MjData, dof: int) -> None:
    """Wake the tree of bodies to which a degree of freedom belongs, if the tree sleeps."""
    if data.qvel[dof] == 0.0:
        data.qvel[dof] = _NUDGE


def wake_all(data: mujoco.MjData, dofs: NDArray[np.int_]) -> None:
    """Wake the trees of bodies to which degrees of freedom belong, if the trees sleep."""
    data.qvel[dofs[data.qvel[dofs] == 0.0]] = _NUDGE


def asleep(data: mujoco.MjData) -> bool:
    """Return True if everything sleeps and no body has been woken since, so that time can pass without computing."""
    return data.ntree_awake == 0 and not (
        data.qvel.any() or data.qfrc_applied.any() or data.xfrc_applied.any()
    )
