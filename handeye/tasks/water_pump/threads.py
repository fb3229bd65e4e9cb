"""Screw threads: when a screw's tip enters a tapped hole rightly turned, the hole's carrier takes its place.

Threads are too fine to simulate by contact. Each tapped hole has a *carrier* in the model: a slide and a turn
bound by the pitch, with a screw head on top. A loose screw is an ordinary body until the events here find, at
a tick, that its tip is in the bore, near the axis, deep enough, turned clockwise and at the phase of the
thread; then it is parked out of sight and the carrier's head becomes real. A screw that enters tilted
cuts its own thread and jams high. From there all is physics again: the head meets the part beneath,
friction grows with the clamp force, and the motor turns the carrier against the driver's body, so that arm
and base feel the torque. Limits of the model are in scenes/water_pump/README.md.
"""

from math import acos, pi, radians
from typing import Annotated, Final

import msgspec
import mujoco
import numpy as np

from handeye.cell.looks import SEEN
from handeye.cell.mechanism import Mechanism
from handeye.cell.screwdriver import SimulatedScrewdriver
from handeye.cell.state import finite
from handeye.cell.truth import Truth
from handeye.pose import Array
from handeye.record import Record
from handeye.tasks.water_pump.pump_world import PumpWorld

CAPTURE: Final = 0.0008  # m, tip to axis. The bore leaves .35 mm of play; assembly study, section 3.
START_DEPTH: Final = 0.00127  # m, tip below the mouth: one turn of the thread.
START_RATE: Final = 3.0  # rad/s, clockwise; slower is mere dragging. Assembly study, section 3.
SQUARE: Final = radians(3.0)  # beyond this tilt the threads cross. Assembly study, section 3.
STEEPEST: Final = radians(20.0)  # beyond this the tip does not bite at all. Placeholder.

RUNNING_TORQUE: Final = 0.02  # N m, a clean thread before the head seats. Assembly study.
CROSSED_TORQUE: Final = 5.0  # N m: more than any driver has. Assembly study.
THREAD_FRICTION: Final = 0.15  # steel on steel, dry. Assembly study.
THREAD_RADIUS: Final = 0.00345  # m, mean thread radius over the cosine of the flank. Assembly study.
STIFF: Final = (0.999, 0.9999, 0.0001)
"""Impedance of a thread. Measured: with MuJoCo's own a screw turns twice more under load, no deeper."""

MOTOR_STIFFNESS: Final = 0.032  # N m s/rad: twice the stall torque at 20 rad/s. Assembly study.
ON_HEAD: Final = (
    0.005,
    0.003,
)  # m, axial and lateral way off a head at which the bit still turns it. Placeholder.
_NUDGE: Final = 1e-12  # rad/s: a velocity that is not zero wakes a sleeping driver
Number = Annotated[int, msgspec.Meta(ge=0)]


class Thread(Record, frozen=True, kw_only=True):
    """State of one tapped hole."""

    screw: Number | None = None
    """The screw in it."""
    crossed: bool = False
    clamp: float = 0.0
    """Force of the head on the part beneath, N, smoothed over a few ticks, when it was last turned."""


class ThreadsState(Record, frozen=True, kw_only=True):
    """States of all holes."""

    holes: tuple[Thread, ...]
    """In the order of the carriers."""
    driven: Number
    """The hole whose carrier the driver's motor is coupled to."""


class Threads(Mechanism[ThreadsState]):
    """The tapped holes, the loose screws and the driver's motor."""

    name = "threads"
    kind = ThreadsState
    changes = (
        "dof_frictionloss", "actuator_gainprm", "actuator_biasprm", "geom_contype", "geom_conaffinity", "geom_group",
    )  # fmt: skip

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, world: PumpWorld, driver: SimulatedScrewdriver
    ) -> None:
        self._model, self._data, self._driver = model, data, driver
        holes = range(sum(model.body(i).name.startswith("carrier") for i in range(model.nbody)))
        self.holes: tuple[Thread, ...] = tuple(Thread() for _ in holes)
        self._phase = world.thread_phase
        self._friction = THREAD_FRICTION * world.friction["thread"]
        self._base = model.body("base").id
        self._carrier = np.array([model.body(f"carrier{k}").id for k in holes])
        self._slide = [model.joint(f"thread_slide{k}").id for k in holes]
        self._turn = [model.joint(f"thread_turn{k}").id for k in holes]
        self._head = np.array([model.geom(f"head{k}").id for k in holes])
        self._site = [model.site(f"thread{k}").id for k in holes]
        self._screw = np.array([model.body(f"screw{k}").id for k in holes])
        self._tray = [model.site(f"park{k}").id for k in holes]
        self._bit = model.body("bit").id
        root = model.body_rootid
        self._driver_geoms = np.flatnonzero(root[model.geom_bodyid] == root[self._bit])
        self._drive, self._spindle = model.actuator("drive").id, model.actuator("spindle").id
        self._spin = int(model.joint("spindle").dofadr[0])
        self._lead = float(model.eq_data[_helix(model, self._slide[0], self._turn[0]), 1])  # m per radian
        self._head_bits = (int(model.geom_contype[self._head[0]]), int(model.geom_conaffinity[self._head[0]]))
        model.geom_contype[self._head] = 0  # heads of empty holes meet nothing
        model.geom_conaffinity[self._head] = 0
        data.ctrl[model.actuator("magnet").id] = 1.0  # permanent

    @property
    def driven(self) -> int:
        """The hole whose carrier the motor is coupled to."""
        return self._site.index(int(self._model.actuator_trnid[self._drive, 0]))

    @driven.setter
    def driven(self, hole: int) -> None:
        self._model.actuator_trnid[self._drive, 0] = self._site[hole]

    def before(self, seconds: float) -> None:
        """Turn the spindle with the speed of the driver's motor, and let screws take their threads."""
        data, speed = self._data, self._driver.speed
        data.ctrl[self._spindle] = -speed
        if speed != 0 and data.qvel[self._spin] == 0.0:
            data.qvel[self._spin] = _NUDGE
        if speed > 0:
            self._engage(seconds)
        self._couple(speed)

    def state(self) -> ThreadsState:
        return ThreadsState(holes=self.holes, driven=self.driven)

    def check(self, state: ThreadsState) -> None:
        screws = {hole.screw for hole in state.holes if hole.screw is not None} | {state.driven}
        if len(state.holes) != len(self.holes) or max(screws) >= len(self.holes):
            raise ValueError("its screws belong to another scene")
        finite([hole.clamp for hole in state.holes], "a thread")

    def restore(self, state: ThreadsState) -> None:
        self.holes, self.driven = state.holes, state.driven

    # --- loose screws ---

    def _engage(self, seconds: float) -> None:
        """Let every loose screw that meets the conditions take its thread in the time to come (s)."""
        taken = {hole.screw for hole in self.holes}
        mouths = self._data.xpos[self._base] + self._local_mouths() @ self._axes().T
        for j, body in enumerate(self._screw):
            if j in taken:
                continue
            offsets = (self._data.xpos[body] - mouths) @ self._axes()
            k = int(np.argmin(np.hypot(offsets[:, 0], offsets[:, 1])))
            if self.holes[k].screw is None and self._bites(j, k, offsets[k], seconds):
                self._take(j, k, depth=-float(offsets[k, 2]))

    def _axes(self) -> Array:
        return np.asarray(self._data.xmat[self._base].reshape(3, 3))

    def _local_mouths(self) -> Array:
        return np.asarray(self._model.body_pos[self._carrier])

    def _tilt(self, screw: int) -> float:
        axis = self._data.xmat[self._screw[screw]].reshape(3, 3)[:, 2]
        return acos(min(1.0, float(axis @ self._axes()[:, 2])))

    def _bites(self, screw: int, hole: int, offset: Array, seconds: float) -> bool:
        """True if the tip of a screw, `offset` from the mouth of a hole (3,), takes the thread within a time (s)."""
        in_bore = np.hypot(offset[0], offset[1]) < CAPTURE and -offset[2] > START_DEPTH
        rate = -self._rate(screw)
        if not in_bore or rate < START_RATE or self._tilt(screw) > STEEPEST:
            return False
        R = self._axes().T @ self._data.xmat[self._screw[screw]].reshape(3, 3)
        ahead = (np.arctan2(R[1, 0], R[0, 0]) - self._phase[hole]) % (2 * pi)
        return bool(ahead < 1.2 * rate * seconds + 0.05)  # the thread starts within this turn

    def _rate(self, screw: int) -> float:
        """Rate of a loose screw about its own axis, rad/s, counter-clockwise positive."""
        start = self._model.body_dofadr[self._screw[screw]]
        return float(self._data.qvel[start + 5])  # free joints turn in body axes

    def _take(self, screw: int, hole: int, depth: float) -> None:
        """Replace a loose screw by the carrier of the hole."""
        model, data = self._model, self._data
        crossed, rate = self._tilt(screw) > SQUARE, self._rate(screw)
        slide, turn = self._slide[hole], self._turn[hole]
        data.qpos[model.jnt_qposadr[slide]] = -depth
        data.qpos[model.jnt_qposadr[turn]] = -depth / self._lead
        data.qvel[model.jnt_dofadr[turn]] = rate
        data.qvel[model.jnt_dofadr[slide]] = rate * self._lead
        geom = self._head[hole]
        model.geom_contype[geom], model.geom_conaffinity[geom] = self._head_bits
        model.geom_group[model.geom_bodyid == self._carrier[hole]] = SEEN
        self._park(screw)
        self.holes = (*self.holes[:hole], Thread(screw=screw, crossed=crossed), *self.holes[hole + 1 :])
        self._rub(hole)
        mujoco.mj_forward(model, data)

    def _park(self, screw: int) -> None:
        """Lay a replaced screw on the tray below the floor."""
        model, data = self._model, self._data
        body = self._screw[screw]
        free = model.body_jntadr[body]
        start, dof = model.jnt_qposadr[free], model.jnt_dofadr[free]
        data.qpos[start : start + 3] = data.site_xpos[self._tray[screw]]
        data.qpos[start + 3 : start + 7] = (1.0, 0.0, 0.0, 0.0)
        data.qvel[dof : dof + 6] = 0.0

    # --- the motor ---

    def _couple(self, speed: float) -> None:
        """Let the motor turn the head that the bit is on, if any."""
        model, data = self._model, self._data
        hole = self._under_bit()
        gain = MOTOR_STIFFNESS if hole is not None and speed != 0.0 else 0.0
        model.actuator_gainprm[self._drive, 0] = gain
        model.actuator_biasprm[self._drive, 2] = -gain
        data.ctrl[self._drive] = -speed
        if hole is not None:
            self.driven = hole
            self._rub(hole)

    def _under_bit(self) -> int | None:
        """The hole whose screw head is in the bit's socket."""
        filled = [k for k, hole in enumerate(self.holes) if hole.screw is not None]
        if not filled:
            return None
        data = self._data
        bit, R = data.xpos[self._bit], data.xmat[self._bit].reshape(3, 3)
        heads = self._head[filled]
        top = data.geom_xpos[heads] + R[:, 2] * self._model.geom_size[heads, 1][:, None]
        offsets = (top - bit) @ R
        on = (np.abs(offsets[:, 2]) < ON_HEAD[0]) & (np.hypot(offsets[:, 0], offsets[:, 1]) < ON_HEAD[1])
        return filled[int(np.argmax(on))] if on.any() else None

    def _rub(self, hole: int) -> None:
        """Friction of a thread for its present clamp force."""
        if not self._data.body_awake[self._base]:  # its contacts are not kept up to date, but nothing moves
            return
        state = self.holes[hole]
        clamp = (state.clamp + self.head_force(hole)) / 2  # a head that chatters on its seat still presses
        torque = CROSSED_TORQUE if state.crossed else RUNNING_TORQUE + self._friction * THREAD_RADIUS * clamp
        self._model.dof_frictionloss[self._model.jnt_dofadr[self._turn[hole]]] = min(torque, CROSSED_TORQUE)
        self.holes = (
            *self.holes[:hole],
            msgspec.structs.replace(state, clamp=clamp),
            *self.holes[hole + 1 :],
        )

    def head_force(self, hole: int) -> float:
        """Force with which the head of a hole's screw presses on the part beneath it, N."""
        contact, head = self._data.contact, self._head[hole]
        pairs = contact.geom
        mine = (pairs == head).any(axis=1) & ~np.isin(pairs, self._driver_geoms).any(axis=1)
        rows = contact.efc_address[mine & (contact.efc_address >= 0)]
        return float(self._data.efc_force[rows].sum())  # elliptic cones: a contact's first row is its normal


def holes_of(truth: Truth) -> tuple[Thread, ...]:
    """The tapped holes of the base, in the order of the carriers."""
    state = truth.states[Threads.name]
    assert isinstance(state, ThreadsState)
    return state.holes


def _helix(model: mujoco.MjModel, slide: int, turn: int) -> int:
    """The constraint that binds a slide to a turn by the pitch."""
    for e in np.flatnonzero(model.eq_type == mujoco.mjtEq.mjEQ_JOINT):
        if (model.eq_obj1id[e], model.eq_obj2id[e]) == (slide, turn):
            return int(e)
    raise AssertionError("the scene binds no slide to its turn")
