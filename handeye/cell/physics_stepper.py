"""Advances the physics in steps. While everything sleeps, no step is computed. The steps are long while only carried
parts touch other bodies, and short while there are any other contacts. If the task allows middle steps, which are
shorter than long steps, most of these other contacts are computed in middle steps instead of short steps.

Contacts need short steps, because their softness grows with the square of the length of the step. Free motion does not
need short steps: with long steps it has the same speeds, but is early by 1.6 ms, half of the difference between a long
step and a short step. Brakes and dry friction of joints are constraints, as contacts are, but may be computed in long
steps. A joint held by friction creeps at up to 9e-6 rad/s with long steps, and at up to 4e-6 rad/s with short steps.

A part that is carried through the air touches only the bodies that hold it. If the task names the pairs of bodies that
touch, the steps are long while the part has only these contacts. In long steps these contacts are made stiffer, so
that a part sinks as deep into the fingers as in short steps (`stiffened`). Contacts may neither begin nor end in long
steps. If a finger that presses with 80 N lost its contact with the part in a long step, the finger would move 1.5 mm
into the part before the next step detected the contact, and would throw the part away.

In middle steps, all contacts and couplings are made stiffer in the same way. The forces between bodies at rest are
therefore the same in short and in middle steps. All contacts except those of the hand may begin and end in middle
steps. The task names the *delicate* contacts, which need short steps, and the joints that must be at rest in middle
steps. A screw, for example, is tightened in short steps, because in middle steps it would clamp with less force.

If a part is crushed, for example between a fixture and a hand that runs into it, the computation may diverge in short
steps. The same interval of time is then computed again, in fine steps. An interval is also computed again if the force
on a finger pad is greater than hand and arm can exert (`CRUSHING`). For example, a finger presses askew into a corner
of a hole, and overloaded friction lifts the finger off for one short step. In this step, the motor drives the free
finger .1 mm into the corner, where it overlaps several faces at once. The simulator then pushes the finger out with
thousands of newtons, and so throws the part about in the hand. In fine steps, the finger only slides.

Fine steps are also made when fingers are too fast for their servo: its damping alone would then exceed the force limit
of the motor. MuJoCo applies a force limit at the beginning of a step, and leaves the damping of a motor at its limit
out of the implicit integration. The motor therefore brakes with its full force during a whole step. With 20 N, one long
step is enough to reverse the fingers, and with 80 N, one short step. Each later step would reverse them again, so the
fingers would swing for ever. In fine steps, they come to rest.

Euler's method moves the joints, and with them the hand, along an arc. It moves a free body along the tangent. For a
free body, Euler's method thus leaves out the second-order term of the motion: half the acceleration times the square
of the step. After long steps this term is therefore added to carried bodies; it is a few micrometres in a servo
period. The term does not fix a part to the hand: only friction holds the part, which can therefore still slip in the
fingers. Short steps leave the term out. A held part therefore creeps more in short steps than in long steps.

MuJoCo puts a tree of bodies to sleep when the tree, and everything it touches, has hardly moved for ten steps. MuJoCo
wakes a sleeping tree when an awake body touches the tree, but not when a motor receives a new command. Code that
drives a motor must therefore wake the tree of this motor.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.contact_memo import ContactMemo
from handeye.core.errors import PhysicsFailed
from handeye.core.small_arrays import span

LONGER: Final = 4
"""Number of short steps in a long step. Our choice: a servo period is then a whole number of long steps, and friction
still holds joints and parts.
"""
MIDDLE: Final = 2
"""Number of short steps in a step of medium length."""
FINER: Final = 8
"""Number of fine steps in a short step. Our choice: a hand that runs into a fixture at 3 m/s goes .4 mm in a fine step.
"""
CRUSHING: Final = 1000.0
"""Greatest force (N) on a finger pad that is accepted in short steps. The motor of the Stanford hand presses with at
most 80 N, and the boom of the arm with at most 200 N: together, 280 N. Impacts exert more, so we multiply by 3.6, a
factor of our choice. See "Crushed fingers" in `docs/figures.md`.
"""
_WHOLE_STATE: Final = int(mujoco.mjtState.mjSTATE_INTEGRATION)
RESTING: Final = 1e-2
"""A joint that moves no faster than this speed (rad/s, m/s) counts as at rest. The limit is our choice. It is well
above the creep of a joint that friction holds: less than 1e-4.
"""
_STIFFEST: Final = 0.9999  # MuJoCo's limit for the impedance of a constraint
_JUDGED: Final = 1000  # sets of pairs of bodies that are remembered
BodyPairs = frozenset[tuple[int, int]]  # numbers of bodies, the smaller first


@dataclass(frozen=True, slots=True, kw_only=True)
class Carrying:
    """The contacts that are allowed in long steps and in middle steps. Bodies are given by name."""

    hand: str  # the body that moves everything that is carried
    pairs: tuple[tuple[str, str], ...]  # allowed in long steps: the hand and a free body, or two free bodies
    delicate: tuple[tuple[str, ...], ...] | None = None
    """The contacts that are not allowed in middle steps. A tuple with two bodies stands for their contact with each
    other; a tuple with one body stands for every contact of this body. If `delicate` is None, the simulation takes no
    middle steps.
    """
    resting: tuple[str, ...] = ()  # joints that do not move during middle steps


def stiffened(
    impedances: NDArray[np.float64], time_constants: NDArray[np.float64], short: float, times: int
) -> NDArray[np.float64]:
    """Return impedances, shape (n, 5), for steps that are longer than short steps by the factor `times`. With these
    impedances, the constraints are as stiff as they are in short steps.

    MuJoCo raises the time constant T (s) of a constraint to at least two timesteps. At impedance d, and at the largest
    impedance D, the stiffness is proportional to d**2 / (D**2 * T**2 * (1 - d)) (MuJoCo's documentation, "Solver
    parameters"). The result is exact at the surface and at full depth, except where MuJoCo limits the impedance.
    Constraints whose stiffness is given directly, by a negative number, keep their impedance.
    """
    lengths = np.maximum(time_constants, 2 * short * times) / np.maximum(time_constants, 2 * short)
    factors = np.where(time_constants > 0, lengths**2, 1.0)
    first, last = impedances[:, :2].T
    found = impedances.copy()
    found[:, 1] = np.minimum(1 - (1 - last) / factors, _STIFFEST)
    aim = factors * (found[:, 1] / last) ** 2 * first**2 / (1 - first)
    found[:, 0] = np.minimum(2 * aim / (aim + np.sqrt(aim * (aim + 4))), _STIFFEST)
    return found


def check_physics(
    warnings: NDArray[np.integer[Any]], rates: NDArray[np.float64], fastest: float = np.inf
) -> None:
    """Raise PhysicsFailed if the simulator has given a warning, or if a body moves faster than `fastest` (m/s,
    rad/s). `warnings` gives the number of warnings of each kind, and `rates` gives the rate of each joint.
    """
    counts = warnings.tolist()
    if any(counts):
        name = mujoco.mjtWarning(next(kind for kind, count in enumerate(counts) if count)).name
        raise PhysicsFailed(f"the simulated cell broke down ({name})")
    if rates.dot(rates) < fastest * fastest:  # a quick test: then no single rate is as fast
        return
    if not np.abs(rates).max(initial=0.0) < fastest:  # also true for NaN
        raise PhysicsFailed(
            f"the simulated cell broke down (something moves faster than {fastest:g} m/s or rad/s)"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Contacts:
    """The contacts of a scene, and the lengths of steps that these contacts allow."""

    pairs: BodyPairs
    of_hand: BodyPairs  # the pairs with a body that the arm moves
    carried: bool
    """True if all these contacts are allowed in long steps."""
    delicate: bool
    """True if at least one pair of bodies that touch is not allowed in steps of medium length."""
    held: tuple[tuple[int, int], ...]
    """The free bodies that the hand carries, each with the index of its pose among the positions of the simulator.
    Empty if `carried` is false.
    """


class PhysicsStepper:
    """Advances the physics of a cell.

    If a contact begins or ends during a long step, the long steps of this period are undone, and short steps are made
    from the last moment before the change. Steps of medium length are undone if the hand gains or loses a contact, or
    if a delicate contact begins.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, carrying: Carrying | None = None) -> None:
        """`carrying` names the contacts that do not need short steps. By default every contact needs short steps."""
        self._model, self._data, self._short = model, data, float(model.opt.timestep)
        self._option, self._contacts = model.opt, ContactMemo(data, self._judged)
        self._allowing = lru_cache(maxsize=_JUDGED)(self._allowed_by)
        self._moves = (data.qpos, data.qvel, data.act, data.qacc_warmstart)
        self._kept = [values.copy() for values in self._moves]
        self._warnings, self._before = data.warning.number, np.empty(mujoco.mj_stateSize(model, _WHOLE_STATE))
        self._hand = 0 if carrying is None else model.body(carrying.hand).id
        self._carried = self._marked(() if carrying is None else carrying.pairs)
        self._handled = self._marked(() if carrying is None else ((carrying.hand,),))
        delicate = None if carrying is None else carrying.delicate
        self._delicate = ~self._marked(()) if delicate is None else self._marked(delicate)
        resting = () if carrying is None else carrying.resting
        self._resting = span(np.array([model.joint(name).dofadr[0] for name in resting], dtype=np.intp))
        touch = model.sensor_type == int(mujoco.mjtSensor.mjSENS_TOUCH)
        self._pads, self._felt = model.sensor_adr[touch].tolist(), data.sensordata  # forces on finger pads
        tendons = model.actuator_trntype == int(mujoco.mjtTrn.mjTRN_TENDON)  # their lengths are the gaps
        self._finger_motors = np.flatnonzero(tendons & (model.actuator_forcelimited != 0)).tolist()
        self._drives = (data.actuator_velocity, model.actuator_biasprm, model.actuator_forcerange)
        roots = [(int(body), int(model.body_jntadr[body])) for body in model.tree_bodyadr]
        self._free = [(body, int(model.jnt_qposadr[joint])) for body, joint in roots]  # of each tree
        self._bends = np.zeros((2, 3, model.nv))
        self._impedances = (model.geom_solimp, model.eq_solimp)
        self._soft = [impedance.copy() for impedance in self._impedances]
        self._stiff = {
            times: [
                stiffened(impedance, constants[:, 0], self._short, times)
                for impedance, constants in zip(self._soft, (model.geom_solref, model.eq_solref), strict=True)
            ]
            for times in (MIDDLE, LONGER)
        }

    def _marked(self, pairs: Iterable[tuple[str, ...]]) -> NDArray[np.bool_]:
        """Return a symmetric table of pairs of trees. For each pair of named bodies, the pair of their trees is
        marked. If only one body is named, all pairs with its tree are marked. The last row is for bodies fixed in the
        world.
        """
        model = self._model
        table = np.zeros((model.ntree + 1, model.ntree + 1), dtype=bool)
        for first, *others in pairs:
            row = model.body_treeid[model.body(first).id]
            column = model.body_treeid[model.body(others[0]).id] if others else slice(None)
            table[row, column] = table[column, row] = True
        return table

    def step(self, steps: int) -> None:
        """Advance by `steps` short steps, or by longer steps that cover the same time. If the computation diverges,
        a finger is crushed, or fingers are too fast for their servo, the time is covered again in *fine* steps, which
        are shorter than short steps.
        """
        mujoco.mj_getState(self._model, self._data, self._before, _WHOLE_STATE)
        broken = self._warned()
        self._advance(steps)
        if (self._warned() or self._too_coarse()) and not broken:
            self._again(steps)

    def _warned(self) -> bool:
        return any(self._warnings.tolist())

    def _too_coarse(self) -> bool:
        """Return True if the last step was too long for the fingers."""
        return self._crushed() or self._overspeed()

    def _overspeed(self) -> bool:
        """Return True if, at the beginning of the last step, fingers moved so fast that the damping of their servo
        alone exceeded the force limit of their motor.
        """
        rates, gains, forces = self._drives
        return any(
            abs(rates.item(motor) * gains.item(motor, 2)) > forces.item(motor, 1)
            for motor in self._finger_motors
        )

    def _crushed(self) -> bool:
        """Return True if the force on a finger pad was greater than `CRUSHING` in the last step."""
        return any(self._felt.item(pad) > CRUSHING for pad in self._pads)

    def _advance(self, steps: int) -> None:
        touching = self._contacts.now()
        if touching.carried and not steps % LONGER:
            done = self._smoothly(steps, touching)
        else:
            done = not (steps % MIDDLE or touching.delicate) and self._midway(steps, touching.of_hand)
        for _ in range(0 if done else steps):
            self._closely(1)
            if self._too_coarse():
                return

    def _closely(self, steps: int) -> None:
        """Make short steps. A subclass may watch them."""
        mujoco.mj_step(self._model, self._data, steps)

    def _again(self, steps: int) -> None:
        """Go back to the beginning of the last `steps` short steps, and make fine steps instead. First restore the
        state and the controls, because MuJoCo may have reset both when it gave a warning.
        """
        model, data = self._model, self._data
        mujoco.mj_setState(model, data, self._before, _WHOLE_STATE)
        self._warnings[:] = 0
        began = data.time
        self._option.timestep = self._short / FINER
        try:
            self._closely(steps * FINER)
        finally:
            self._option.timestep = self._short
        data.time = began + steps * self._short

    def _judged(self, geoms: NDArray[np.int32]) -> _Contacts:
        first, second = self._model.geom_bodyid[geoms].T.tolist()
        return self._allowing(
            frozenset([(a, b) if a < b else (b, a) for a, b in zip(first, second, strict=True)])
        )

    def _allowed_by(self, pairs: BodyPairs) -> _Contacts:
        """Judge which steps are allowed while the bodies in each of the pairs `pairs` touch. The result depends only
        on the pairs, and many sets of contacts have the same pairs.
        """
        bodies = np.array(sorted(pairs), dtype=np.intp).reshape(-1, 2)
        first, second = self._model.body_treeid[bodies].T
        carried = bool(self._carried[first, second].all())
        return _Contacts(
            pairs=pairs,
            of_hand=_pairs(bodies[self._handled[first, second]]),
            carried=carried,
            delicate=bool(self._delicate[first, second].any()),
            held=self._held(pairs) if carried else (),
        )

    def _smoothly(self, steps: int, touching: _Contacts) -> bool:
        """Make long steps. If a contact begins or ends, undo all these steps and return False."""

        def same() -> bool:
            return self._contacts.now().pairs == touching.pairs

        def arrived() -> bool:
            mujoco.mj_kinematics(self._model, self._data)
            mujoco.mj_collision(self._model, self._data)
            return same()

        done = self._longer(steps, LONGER, same, arrived)
        if done and touching.pairs:
            self._add_second_order(steps, touching.held)
        return done

    def _midway(self, steps: int, of_hand: BodyPairs) -> bool:
        """Make middle steps. If the hand gains or loses a contact, if a delicate contact begins, or if a joint that
        must be at rest moves, undo all these steps and return False.
        """

        def allowed() -> bool:
            touching = self._contacts.now()
            return touching.of_hand == of_hand and not touching.delicate

        return self._at_rest() and self._longer(steps, MIDDLE, allowed, self._at_rest)

    def _at_rest(self) -> bool:
        return all(abs(rate) < RESTING for rate in self._data.qvel[self._resting].tolist())

    def _longer(
        self,
        steps: int,
        times: int,
        allowed: Callable[[], bool],
        at_the_end: Callable[[], bool] = lambda: True,
    ) -> bool:
        """Replace `steps` short steps by fewer long steps. A long step is `times` times as long as a short step. If
        the contacts of a step are not allowed, or fingers are too fast, undo all steps and return False.
        """
        model, data, began = self._model, self._data, self._data.time
        for kept, values in zip(self._kept, self._moves, strict=True):
            kept[:] = values
        self._option.timestep = self._short * times
        self._set_impedances(self._stiff[times])
        try:
            for _ in range(steps // times):
                mujoco.mj_step(model, data)  # its contacts are those at its beginning
                if self._overspeed() or not allowed():
                    done = False
                    break
            else:
                done = at_the_end()
        finally:
            self._option.timestep = self._short
            self._set_impedances(self._soft)
        if not done:
            for kept, values in zip(self._kept, self._moves, strict=True):
                values[:] = kept
        data.time = began + steps * self._short if done else began
        return done

    def _set_impedances(self, values: Sequence[NDArray[np.float64]]) -> None:
        for impedance, value in zip(self._impedances, values, strict=True):
            impedance[:] = value

    def _held(self, touching: BodyPairs) -> tuple[tuple[int, int], ...]:
        """Return the bodies that the hand carries. `touching` gives the pairs of bodies that touch (see `_Contacts`).
        A carried body touches the hand or another carried body.
        """
        pairs = [{int(self._model.body_treeid[body]) for body in pair} for pair in touching]
        hand = int(self._model.body_treeid[self._hand])
        reached, before = {hand}, 0
        while len(reached) > before:
            before = len(reached)
            reached = reached.union(*(pair for pair in pairs if reached & pair))
        return tuple(self._free[tree] for tree in sorted(reached - {hand}))

    def _add_second_order(self, steps: int, held: tuple[tuple[int, int], ...]) -> None:
        """Correct the motion of the carried bodies in long steps that cover the time of `steps` short steps. Euler's
        method leaves out a second-order term when the hand moves along an arc: half the velocity-dependent
        acceleration, times the square of the long step. The term is added.
        """
        model, data = self._model, self._data
        mujoco.mj_comPos(model, data)
        mujoco.mj_comVel(model, data)
        late = LONGER * self._short * steps * self._short / 2.0  # s2: half a step, over all of them
        for body, start in held:
            mujoco.mj_jacDot(model, data, self._bends[0], self._bends[1], data.xpos[body], self._hand)
            way, turn = late * (self._bends @ data.qvel)
            data.qpos[start : start + 3] += way
            along = data.xmat[body].reshape(3, 3).T @ turn  # quaternions turn about a body's own axes
            mujoco.mju_quatIntegrate(data.qpos[start + 3 : start + 7], along, 1.0)


def _pairs(bodies: NDArray[np.integer[Any]]) -> BodyPairs:
    return frozenset((int(one), int(other)) for one, other in bodies)


_NUDGE: Final = 1e-12  # in rad/s or m/s: a velocity that is not zero wakes a tree
_READY: Final = -1  # of a tree that will fall asleep after the next step in which it hardly moves
_POLICY: Final = {
    True: int(mujoco.mjtSleepPolicy.mjSLEEP_ALLOWED),
    False: int(mujoco.mjtSleepPolicy.mjSLEEP_NEVER),
}


def allow(model: mujoco.MjModel, tree: int, *, allowed: bool = True) -> None:
    """Allow the simulator to put a tree of bodies to sleep, or keep the tree awake. The tree has motors."""
    model.tree_sleep_policy[tree] = _POLICY[allowed]


def wake(data: mujoco.MjData, dof: int) -> None:
    """Wake the tree of bodies to which a degree of freedom belongs, if the tree sleeps."""
    if data.qvel[dof] == 0.0:
        data.qvel[dof] = _NUDGE


def wake_all(data: mujoco.MjData, dofs: NDArray[np.int_]) -> None:
    """Wake the sleeping trees of bodies to which the degrees of freedom `dofs` belong."""
    data.qvel[dofs[data.qvel[dofs] == 0.0]] = _NUDGE


def let_rest(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Prepare the trees of bodies that have no velocity: each falls asleep after the next step, if the tree is still
    at rest.

    MuJoCo sets the velocities of a sleeping tree to zero, so a tree without any velocity was asleep until now.
    """
    resting = np.ones(model.ntree, dtype=bool)
    resting[model.dof_treeid[data.qvel != 0.0]] = False
    data.tree_asleep[resting] = _READY


def asleep(data: mujoco.MjData) -> bool:
    """Return True if everything sleeps and no body has been woken since, so that time can pass without computing."""
    return data.ntree_awake == 0 and not (
        data.qvel.any() or data.qfrc_applied.any() or data.xfrc_applied.any()
    )
