"""Screw threads: when the tip of a screw enters a tapped hole and the screw is turned the right way, the carrier of
the hole replaces the screw.

Threads are too fine to simulate by contact. Each tapped hole has a carrier in the model (`carriers.py`). A loose screw
is an ordinary body until three conditions are met at the same tick: its tip is in the bore, near the axis and deep
enough; the screw turns clockwise; and its angle matches the phase of the thread. The body of the screw is then parked
out of sight, and the carrier takes its place. A screw that enters at an angle cuts its own thread, stays at that
angle, and jams before it is seated. Once the carrier has taken the place of the screw, the physics computes all that
follows: the shank touches the holes of the parts above, the head touches the part beneath, and friction grows with the
clamp force. The motor turns the carrier against the body of the driver, so the torque acts on the body that holds the
driver, and on the tapped part. A screw that is turned back to the place where its thread began is loose again.
scenes/water_pump/README.md lists the simplifications of this model.

In a scene with screws, the screws are numbered from 0, and the scene uses the following names. Each screw is a free
body `screw0`, whose origin is the point of the screw, with a geom `screw_head0` and a site `park0` out of sight. Each
carrier is a body `carrier0` in the tapped body, with the site `thread0`, the joints `thread_slide0` and
`thread_turn0`, and the geoms `head0` and `shank0`. The only driver has the geom `bit`, the joint and actuator
`spindle`, and the actuators `magnet` and `drive`; `drive` acts between the site of a thread and the body of the driver.
"""

from collections.abc import Set
from dataclasses import dataclass
from math import acos, dist, pi, radians
from typing import Annotated, Final, Protocol

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.carriers import Carriers
from handeye.cell.contact_memo import ContactMemo
from handeye.cell.mechanism import Mechanism, scene_for
from handeye.cell.physics_stepper import wake
from handeye.cell.signal_lines import SOUND, SignalLines
from handeye.cell.state import finite
from handeye.cell.truth import Truth
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.core.pose import Array, Pose, pose, translated
from handeye.core.record import Record

CAPTURE: Final = 0.0004  # m, tip to axis. The bore leaves the point .35 mm of play.
START_DEPTH: Final = 0.00127  # m, tip below the mouth: one turn of the thread.
START_RATE: Final = 3.0  # rad/s, clockwise; slower is mere dragging. Assembly study, section 3.
SQUARE: Final = radians(3.0)  # beyond this tilt the threads cross. Assembly study, section 3.
SCARRED: Final = radians(2.0)  # the same in a thread that a crossed screw has cut. Placeholder.
STEEPEST: Final = radians(20.0)  # beyond this the tip does not bite at all. Placeholder.

RUNNING_TORQUE: Final = 0.02  # N m, a clean thread before the head seats. Assembly study.
CROSSED_TORQUE: Final = 5.0  # N m: more than any driver has. Assembly study.
BACKING_TORQUE: Final = 0.2
"""Torque (N m) that turns a crossed screw back. This torque is smaller than the torque with which the screwdriver
jammed the screw. Placeholder: the value has no source.
"""
THREAD_FRICTION: Final = 0.15  # steel on steel, dry. Assembly study.
THREAD_RADIUS: Final = 0.00345  # m, mean thread radius over the cosine of the flank. Assembly study.
STIFF: Final = (0.999, 0.9999, 0.0001)
"""Constraint impedance of a thread. With MuJoCo's default impedance, a screw under load made two further turns without
going deeper: we measured this.
"""

MOTOR_STIFFNESS: Final = 0.032  # N m s/rad: twice the stall torque at 20 rad/s. Assembly study.
IN_SLOT: Final = 1e-4  # m between bit and head: contacts chatter by less, and a slot is 1.2 mm deep.
NEAR: Final = 0.03  # m between the middles of bit and head: farther, they cannot meet.
ON_HEAD: Final = 5e-4  # m between their axes: the ring around the head leaves .3 mm.
Number = Annotated[int, msgspec.Meta(ge=0)]


class Thread(Record, frozen=True, kw_only=True):
    """State of the thread in one tapped hole."""

    screw: Number | None = None  # the screw in it
    crossed: bool = False  # it has cut a thread of its own
    scarred: bool = False  # a screw has been crossed in it, now or before
    clamp: float = 0.0
    """Force (N) with which the head of the screw pressed on the part beneath when the screw was last turned. The force
    is smoothed over a few ticks.
    """


class ThreadsState(Record, frozen=True, kw_only=True):
    """States of all tapped holes, and the number of the hole whose screw is driven."""

    holes: tuple[Thread, ...]  # in the order of the carriers
    driven: Number  # the hole whose carrier the driver's motor is coupled to


class Driver(Protocol):
    """A powered screwdriver, with the settings of its motor."""

    @property
    def speed(self) -> float:
        """Speed of the spindle, in rad/s; a positive speed drives a screw in."""

    @property
    def magnet(self) -> bool:
        """True if the magnet of the bit is on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ThreadFigures:
    """True dimensions of threads and screws. Holes and screws are numbered from 0."""

    phases: tuple[float, ...]  # where the thread of each hole starts, in rad
    friction: float = THREAD_FRICTION
    scarred: Set[int] = frozenset()  # holes in which a screw has been crossed before
    crossing: Set[int] = frozenset()  # holes in which every screw crosses
    slipping: Set[int] = frozenset()
    """Screws on which the bit slips. Such a screw enters no thread, even if a part other than the bit turns it a
    little.
    """


class Threads(Mechanism[ThreadsState]):
    """The tapped holes, the loose screws and the motor of the driver."""

    name = "threads"
    kind = ThreadsState
    changes = ("dof_frictionloss", "actuator_gainprm", "actuator_biasprm", *Carriers.changes)

    @scene_for("screw threads")
    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        driver: Driver,
        figures: ThreadFigures,
        lines: SignalLines = SOUND,
    ) -> None:
        """Start with empty holes. The line `magnet` carries a factor that multiplies the force of the bit's magnet."""
        self._model, self._data, self._driver, self._lines = model, data, driver, lines
        self._carriers, self._figures = Carriers(model, data), figures
        if len(figures.phases) != self._carriers.count:
            raise BadArgument(
                f"the scene has {counted(self._carriers.count, 'tapped hole')}, not {len(figures.phases)}"
            )
        holes = range(self._carriers.count)
        self.holes: tuple[Thread, ...] = tuple(Thread(scarred=k in figures.scarred) for k in holes)
        self._base = self._carriers.base
        self._screw = np.array([model.body(f"screw{k}").id for k in holes])
        self._tray = [model.site(f"park{k}").id for k in holes]
        self._bit = model.geom("bit").id
        root, bit = model.body_rootid, model.geom_bodyid[self._bit]
        self._driver_geoms = np.flatnonzero(root[model.geom_bodyid] == root[bit])
        self._drive, self._spindle = model.actuator("drive").id, model.actuator("spindle").id
        self._spin = int(model.joint("spindle").dofadr[0])
        self._magnet = model.actuator("magnet").id
        self._seats = ContactMemo(data, self._of_heads)
        self._attract()

    @property
    def driven(self) -> int:
        """Number of the hole whose carrier is coupled to the motor."""
        return self._carriers.site.index(int(self._model.actuator_trnid[self._drive, 0]))

    @driven.setter
    def driven(self, hole: int) -> None:
        self._model.actuator_trnid[self._drive, 0] = self._carriers.site[hole]

    def before(self, seconds: float) -> None:
        """Turn the spindle at the speed of the driver's motor, and let screws enter and leave their threads."""
        data, speed = self._data, self._driver.speed
        data.ctrl[self._spindle] = -speed
        self._attract()
        if speed != 0:
            wake(data, self._spin)
        turned = {
            hole for hole, thread in enumerate(self.holes) if thread.screw is not None and not thread.crossed
        }
        if turned:
            for hole in turned.intersection(self._carriers.leaning()):
                self._carriers.straighten(hole, seconds)
        if speed > 0:
            self._engage(seconds)
        if speed < 0:
            self._disengage()
        self._couple(speed)

    def _attract(self) -> None:
        """Apply the force of the bit's magnet if the magnet is on."""
        self._data.ctrl[self._magnet] = self._lines.carried("magnet", float(self._driver.magnet))

    def state(self) -> ThreadsState:
        return ThreadsState(holes=self.holes, driven=self.driven)

    def check(self, state: ThreadsState) -> None:
        screws = {hole.screw for hole in state.holes if hole.screw is not None} | {state.driven}
        if len(state.holes) != len(self.holes) or max(screws) >= len(self.holes):
            raise ValueError("the saved screws belong to another scene")
        finite([hole.clamp for hole in state.holes], "a thread")

    def restore(self, state: ThreadsState) -> None:
        self.holes, self.driven = state.holes, state.driven

    def _set(self, hole: int, thread: Thread) -> None:
        self.holes = (*self.holes[:hole], thread, *self.holes[hole + 1 :])

    # --- loose screws ---

    def _engage(self, seconds: float) -> None:
        """Let each loose screw enter a thread if it meets the conditions of `_bites` within the next `seconds`."""
        taken = {hole.screw for hole in self.holes}
        mouths = self._data.xpos[self._base] + self._carriers.mouths @ self._axes().T
        for j, body in enumerate(self._screw):
            if j in taken or j in self._figures.slipping:
                continue
            offsets = (self._data.xpos[body] - mouths) @ self._axes()
            k = int(np.argmin(np.hypot(offsets[:, 0], offsets[:, 1])))
            if self.holes[k].screw is None and self._bites(j, k, offsets[k], seconds):
                head = self._model.geom(f"screw_head{j}").id
                depth = mujoco.mj_geomDistance(self._model, self._data, self._bit, head, 0.0, None)
                X_WS = self._pose(
                    j
                )  # out of the bit: a carrier does not give way, and would throw the driver off
                self.take(j, k, translated(X_WS, min(depth, 0.0) * X_WS[:3, 2]))

    def _axes(self) -> Array:
        return np.asarray(self._data.xmat[self._base].reshape(3, 3))

    def _pose(self, screw: int) -> Pose:
        body = self._screw[screw]
        return pose(self._data.xmat[body].reshape(3, 3).copy(), self._data.xpos[body].copy())

    def _bites(self, screw: int, hole: int, offset: Array, seconds: float) -> bool:
        """Return True if the tip of a screw enters the thread of a hole within `seconds`. `offset` is the position of
        the tip relative to the mouth of the hole, shape (3,), in m.
        """
        in_bore = np.hypot(offset[0], offset[1]) < CAPTURE and -offset[2] > START_DEPTH
        rate = -self._rate(screw)
        if not in_bore or rate < START_RATE or self._tilt(self._pose(screw)) > STEEPEST:
            return False
        R = self._axes().T @ self._pose(screw)[:3, :3]
        ahead = (np.arctan2(R[1, 0], R[0, 0]) - self._figures.phases[hole]) % (2 * pi)
        return bool(ahead < 1.2 * rate * seconds + 0.05)  # the thread starts within this turn

    def _tilt(self, X_WS: Pose) -> float:
        return acos(min(1.0, float(X_WS[:3, 2] @ self._axes()[:, 2])))

    def _rate(self, screw: int) -> float:
        """Return the rotation rate of a loose screw about its axis, in rad/s. The rate is positive if the screw turns
        counter-clockwise.
        """
        return float(self._data.qvel[self._free(screw)[1] + 5])  # free joints turn in body axes

    def _free(self, screw: int) -> tuple[int, int]:
        """Return two indices: where the positions of a loose screw begin in the state of the simulator, and where its
        rates begin.
        """
        body = self._screw[screw]
        return int(self._model.jnt_qposadr[self._model.body_jntadr[body]]), int(self._model.body_dofadr[body])

    def take(self, screw: int, hole: int, X_WS: Pose) -> None:
        """Replace a loose screw by the carrier of a hole, at the pose of the screw."""
        scarred = self.holes[hole].scarred
        crossed = hole in self._figures.crossing or self._tilt(X_WS) > (SCARRED if scarred else SQUARE)
        self._carriers.fill(hole, X_WS, self._rate(screw))
        self._put(screw, pose(np.eye(3), self._data.site_xpos[self._tray[screw]]), np.zeros(6))
        self._set(hole, Thread(screw=screw, crossed=crossed, scarred=crossed or scarred))
        self.rub(hole)
        mujoco.mj_forward(self._model, self._data)

    def _disengage(self) -> None:
        """Release a screw that has been turned back to the place where its thread began."""
        hole = self._under_bit()
        if hole is None or self._carriers.depth(hole) > START_DEPTH:
            return
        self._let_go(hole)

    def loosen(self, screw: int, turns: float | None = None) -> bool:
        """Raise a screw in its thread by `turns`, or release the screw if `turns` is None. Returns False if the
        screw is in no thread, or if the bit is on the screw.
        """
        hole = next((k for k, thread in enumerate(self.holes) if thread.screw == screw), None)
        if hole is None or hole == self._under_bit():
            return False
        wake(self._data, self._carriers.friction_of(hole))
        if turns is None:
            self._let_go(hole)
            return True
        self._carriers.turn_back(hole, turns)
        self._set(hole, msgspec.structs.replace(self.holes[hole], clamp=0.0))
        self._model.dof_frictionloss[self._carriers.friction_of(hole)] = RUNNING_TORQUE
        mujoco.mj_forward(self._model, self._data)
        return True

    def _let_go(self, hole: int) -> None:
        """Replace the screw in a hole by a loose screw at the same pose."""
        screw = self.holes[hole].screw
        assert screw is not None
        self._put(screw, self._carriers.pose(hole), self._carriers.velocity(hole))
        self._carriers.empty(hole)
        self._set(hole, Thread(scarred=self.holes[hole].scarred))
        mujoco.mj_forward(self._model, self._data)

    def _put(self, screw: int, X_WS: Pose, velocity: Array) -> None:
        """Move a loose screw to a pose, with angular and linear velocity in W, shape (6,)."""
        data, (start, dof) = self._data, self._free(screw)
        data.qpos[start : start + 3] = X_WS[:3, 3]
        mujoco.mju_mat2Quat(data.qpos[start + 3 : start + 7], X_WS[:3, :3].ravel())
        data.qvel[dof : dof + 3], data.qvel[dof + 3 : dof + 6] = velocity[3:], X_WS[:3, :3].T @ velocity[:3]

    # --- the motor ---

    def _couple(self, speed: float) -> None:
        """If the bit is in the slot of a screw, let the motor turn this screw."""
        model, data = self._model, self._data
        hole = self._under_bit()
        gain = MOTOR_STIFFNESS if hole is not None and speed != 0.0 else 0.0
        model.actuator_gainprm[self._drive, 0] = gain
        model.actuator_biasprm[self._drive, 2] = -gain
        data.ctrl[self._drive] = -speed
        if hole is not None:
            self.driven = hole
            self.rub(hole, back=speed < 0)

    def _under_bit(self) -> int | None:
        """Return the hole whose screw has the bit in its slot, or None if the bit is in no slot."""
        places, filled = (
            self._data.geom_xpos,
            [k for k, thread in enumerate(self.holes) if thread.screw is not None],
        )
        if not filled:
            return None
        bit = places[self._bit].tolist()
        near = (k for k in filled if dist(places[self._carriers.head[k]].tolist(), bit) <= NEAR)
        return next(filter(self._on, near), None)

    def _on(self, hole: int) -> bool:
        """Return True if the bit stands upright over the slot of the screw in a hole, and on the head of this screw.
        Before the call, the caller checks that the bit is near the hole.
        """
        data, head = self._data, self._carriers.head[hole]
        apart = data.geom_xpos[head] - data.geom_xpos[self._bit]
        aside = (apart @ data.geom_xmat[self._bit].reshape(3, 3))[:2]
        if np.hypot(*aside) > ON_HEAD:
            return False
        return mujoco.mj_geomDistance(self._model, data, self._bit, int(head), 2 * IN_SLOT, None) < IN_SLOT

    def rub(self, hole: int, *, back: bool = False) -> None:
        """Set the friction of a thread for its present clamp force. `back` is True if the screw is turned back."""
        if not self._data.body_awake[self._base]:  # its contacts are not kept up to date, but nothing moves
            return
        state = self.holes[hole]
        clamp = (state.clamp + self.head_force(hole)) / 2  # a head that chatters on its seat still presses
        rubbed = msgspec.structs.replace(state, clamp=clamp)
        self._model.dof_frictionloss[self._carriers.friction_of(hole)] = self._torque(rubbed, back=back)
        self._set(hole, rubbed)

    def _torque(self, thread: Thread, *, back: bool = False) -> float:
        """Return the friction torque (N m) of a thread while its screw is turned in or, if `back` is True, turned
        back.
        """
        if thread.crossed:
            return BACKING_TORQUE if back else CROSSED_TORQUE
        return min(RUNNING_TORQUE + self._figures.friction * THREAD_RADIUS * thread.clamp, CROSSED_TORQUE)

    def write(self, holes: tuple[Thread, ...], model: mujoco.MjModel) -> None:
        """Apply thread states to a model of this scene. The model must be in its initial state."""
        for hole, thread in enumerate(holes):
            self._carriers.meet(hole, model, there=thread.screw is not None)
            if thread.screw is not None:
                model.dof_frictionloss[self._carriers.friction_of(hole)] = self._torque(thread)

    def head_force(self, hole: int) -> float:
        """Return the force (N) with which the head of a hole's screw presses on the part beneath."""
        rows = self._data.contact.efc_address[self._seats.now()[hole]]
        forces = self._data.efc_force[rows[rows >= 0]]
        return float(forces.sum())  # elliptic cones: a contact's first row is its normal

    def _of_heads(self, geoms: NDArray[np.int32]) -> list[NDArray[np.intp]]:
        """Return the contacts of each head, except its contacts with the driver."""
        others = ~np.isin(geoms, self._driver_geoms).any(axis=1)
        return [np.flatnonzero((geoms == head).any(axis=1) & others) for head in self._carriers.head]


def holes_of(truth: Truth) -> tuple[Thread, ...]:
    """Return the thread states of the tapped holes of the base, in the order of the carriers."""
    state = truth.states[Threads.name]
    assert isinstance(state, ThreadsState)
    return state.holes
