"""Simulates the two gantries, which are connected to the pins of the microcomputers. Their parts are rotors that
magnetic fields pull along, wrists that bend, switches, light beams and hands.

The fields of all motors are computed in advance from the pulse trains of their firmware, as tables with one row per
millisecond. The physics follows these tables. There are three kinds of events: a force on a wrist crosses its
threshold, a switch changes, or a rotor slips. In each millisecond, one matrix product and one comparison show whether
an event has occurred. Other code runs only after an event.
"""

import math
from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.bench import Bench
from handeye.core.pose import Array
from handeye.core.resources import scenes
from handeye.execution.servo import ServoPeriod
from handeye.ports.axes import Channel
from handeye.ports.workcell import Sensed
from handeye.systems.sigma.bus.plant import TRAVEL, Level, Plant
from handeye.systems.sigma.firmware.device import PS
from handeye.systems.sigma.firmware.force import CONVERTER_N, RELEASED, STANDARD_N
from handeye.systems.sigma.firmware.motor import COUNTING, Motor, Pin
from handeye.systems.sigma.gantries.memory import GantryMemory
from handeye.systems.sigma.gantries.world import (
    BEAM,
    FRICTION,
    GAIN,
    LEFT,
    PULL_OUT,
    STIFFNESS,
    SWITCHES,
    GantryWorld,
)
from handeye.systems.sigma.motors.pulses import CURVES
from handeye.systems.sigma.motors.rotor import MASSES, POLE, STEP, Drive
from handeye.systems.sigma.protocol import AXES, COMPONENTS, DEVICES, LINE_NUMBERS

SCENE: Final = "supersigma/supersigma.xml"
CAMERA: Final = "people"
SWITCHED_ON_AT: Final = 400  # steps of each axis from its low switch at power-on
DIFFERENTIAL: Final = 2e-4  # m by which a switch is released later than it acts
OPEN: Final = 0.044  # m between the fingers
TICK: Final = 1000 * PS  # ps: step of the physics
_HAND_KG: Final = 1.2  # kg: mass of a hand for which the accelerometers are set
_STIFFNESS: Final = 20_000.0  # N/m: stiffness of a wrist for which the strain gauges are set
_DAMPING: Final = 92.95  # N s/m
_GRAVITY: Final = 9.81
_SUNK: Final = 1e-3  # m: depth of the lamp inside its finger, so that a gripped object lies in front of it
_FINGER: Final = 2e-4  # m before the photodiode at which a ray may end, because it meets the other finger
_SENSE: Final = np.array(
    [1.0, 1.0, -1.0, -1.0, 1.0, -1.0]
)  # of each axis of two arms along x, y or z of the scene
_HIGH: Final = 2  # rows of axes: forces one way and the other, high ends, low ends, rotors ahead, and behind
ENDS: Final[dict[int, Pin]] = {_HIGH: "high", _HIGH + 1: "low"}
_AHEAD: Final = 256  # physics steps that are planned together
Table = NDArray[np.float64]


class Rig(NamedTuple):
    """The axes and arms of a machine. The axes of the arms come first, three for each arm. Only these axes have
    wrists.
    """

    axes: tuple[str, ...] = AXES
    arms: tuple[int, ...] = (1, 2)

    @property
    def wrists(self) -> tuple[str, ...]:
        """The axes along which wrists measure forces."""
        return self.axes[: len(COMPONENTS) * len(self.arms)]


SUPERSIGMA: Final = Rig()


def scene(world: GantryWorld) -> mujoco.MjSpec:
    """Return the scene of a world with an empty board."""
    spec = mujoco.MjSpec.from_file(str(scenes() / SCENE))
    vary(spec, world, SUPERSIGMA)
    return spec


def vary(spec: mujoco.MjSpec, world: GantryWorld, rig: Rig) -> None:
    """Give a scene the errors of a world."""
    stiffer = world.axes(STIFFNESS, rig.wrists)
    friction = world.value(FRICTION)
    for axis in rig.axes:
        spec.joint(axis).damping = np.array([friction * MASSES[axis[0]], 0, 0])
    for index, axis in enumerate(rig.wrists):
        spec.joint(f"wrist_{axis}").stiffness = np.array([_STIFFNESS * (1 + stiffer[index]), 0, 0])
    for arm in rig.arms:
        higher = world.normal(f"beam.{arm}", BEAM)
        for end in ("lamp", "photodiode"):
            spec.site(f"{end}_{arm}").pos[2] += higher


class Field(NamedTuple):
    """Positions and speeds of a motor's magnetic field, one row for each physics step from step `first` on. After the
    last row, the field stays where it is.
    """

    first: int
    places: Table  # pulses
    speeds: Table  # pulses/s


class Gantries(Plant[GantryMemory]):
    """Two gantries on a bench."""

    predicts = False
    longest = 200_000

    def __init__(
        self, spec: mujoco.MjSpec, world: GantryWorld, *, rig: Rig = SUPERSIGMA, compensated: bool = True
    ) -> None:
        """Switch the gantries on.

        Args:
            compensated: use the accelerometers to correct the readings of the wrists, so that the force that
                accelerates a hand is not counted.
        """
        self.bench, self.rig, self._n = Bench(spec.compile()), rig, len(rig.axes)
        self.memory = GantryMemory.of(self._n, len(rig.arms))
        self.channels = tuple(
            Channel(name=f"force_{arm}", unit="N", width=len(COMPONENTS)) for arm in rig.arms
        )
        self._axis = {LINE_NUMBERS[axis]: index for index, axis in enumerate(rig.axes)}
        self._wrist = {
            LINE_NUMBERS[f"FORCE{arm}"]: slice(3 * index, 3 * index + 3) for index, arm in enumerate(rig.arms)
        }
        self._hand = {LINE_NUMBERS[name]: int(name[-1]) for name in LINE_NUMBERS if name.startswith("HAND")}
        self._levels, self._all = 4 * self._n, 6 * self._n
        self._places = slice(self._levels, self._levels + self._n)
        self._servos = self._n + len(rig.arms)  # a job may have more motors, which follow these
        self.actuated: list[Callable[[int, Sequence[int]], None]] = []
        """Functions that are called when the outputs of a hand microcomputer have changed. Each function takes the
        number of the microcomputer and its outputs.
        """
        assert self.bench.tick * 10**6 * PS == TICK
        model, data = self.bench.model, self.bench.data
        self._low = world.axes(SWITCHES, rig.axes)  # m: position of the joint of each axis at its low switch
        self._high = self._low + [TRAVEL[axis[0]] * STEP for axis in rig.axes]
        self._begin = self._low + SWITCHED_ON_AT * STEP
        self._pull = 1.0 + world.axes(PULL_OUT, rig.axes)
        servos = [model.actuator(axis).id for axis in rig.axes]
        self._stiff = model.actuator_gainprm[servos, 0].copy()
        self._lead = -model.actuator_biasprm[servos, 2] / self._stiff  # s by which speed leads position
        gain = 1.0 + world.axes(GAIN, rig.wrists)
        gauges, still = _gauges(model, rig, gain, world.value(LEFT) if compensated else 1.0)
        accelerometers = _sensors(
            model, mujoco.mjtSensor.mjSENS_ACCELEROMETER, [f"hand_{arm}" for arm in rig.arms]
        )
        self._inertial = [first + column for first in accelerometers for column in range(len(COMPONENTS))]
        places = np.zeros((self._n, model.nsensordata))
        places[range(self._n), _sensors(model, mujoco.mjtSensor.mjSENS_JOINTPOS, rig.axes)] = 1.0
        self._felt = np.concatenate((gauges, -gauges, places, -places, places, -places))
        self._still = np.concatenate((still, -still, np.zeros(4 * self._n)))
        self._over = np.full(self._n, _least_over(STANDARD_N))
        self._release = np.full(self._n, _least_over(STANDARD_N * RELEASED))
        self._trains: list[object] = [None] * self._n
        self._motors: list[Motor | None] = [None] * self._n
        self._fields = [Field(0, np.zeros(1), np.zeros(1))] * self._n
        self._first = self._step = 0
        self._peaks, self._sensed = np.zeros(2 * self._n), np.empty(self._all)
        self._reduced = False  # True if the last forces were those of rotors that leave their poles
        self._seen: dict[tuple[int, Pin], Level] = {}
        joints = [model.joint(axis) for axis in rig.axes]
        self._q = [int(joint.qposadr[0]) for joint in joints]
        self._qd = [int(joint.dofadr[0]) for joint in joints]
        data.qpos[self._q] = self._begin
        for finger in (f"{side}_{arm}" for arm in rig.arms for side in ("left", "right")):
            data.qpos[model.joint(finger).qposadr[0]] = OPEN / 2
        mujoco.mj_forward(model, data)
        self._known, self._strained = bytes(self._all), False
        self.memory.levels = self._known[: self._levels]
        self._plan()
        self.bench.before_step.append(self._draw)
        self.bench.after_step.append(self._look)

    # -- pins ----------------------------------------------------------------------------------------------

    def next_pin(self, number: int, motor: Motor) -> None:
        return None

    def forces(self, number: int) -> Sequence[float]:
        return [float(force) for force in self.felt[self._wrist[number]]]

    def peaks(self, number: int) -> Sequence[float]:
        part = self._wrist[number]
        peaks, self.memory.peaks[part] = self.memory.peaks[part], [0.0] * len(COMPONENTS)
        return peaks

    def beam(self, number: int) -> bool:
        model, data, hand = self.bench.model, self.bench.data, self._hand[number]
        lamp, photodiode = data.site(f"lamp_{hand}").xpos, data.site(f"photodiode_{hand}").xpos
        if hand in self.rig.arms:
            way = -data.body(f"left_{hand}").xmat.reshape(3, 3)[:, 1]  # from the left finger to the right one
            body, sunk = model.body(f"left_{hand}").id, _SUNK
        else:  # the beam is beside the feeder or the belt
            way, body, sunk = (photodiode - lamp) / np.linalg.norm(photodiode - lamp), -1, 0.0
        length, met = float((photodiode - lamp) @ way) + sunk, np.zeros(1, dtype=np.int32)
        far = mujoco.mj_ray(model, data, lamp - sunk * way, way, None, True, body, met)
        return bool(0 <= far < length - _FINGER)

    def actuate(self, number: int, devices: Sequence[int]) -> None:
        closed, hand = bool(devices[DEVICES["HAND"]]), self._hand[number]
        if hand in self.rig.arms and self.memory.grips[hand - 1] != closed:
            self.memory.grips[hand - 1] = closed
            self._plan()
        for act in self.actuated:
            act(number, devices)

    def limited(self, number: int, thresholds: Sequence[float]) -> None:
        over, part = [*map(_least_over, thresholds)], self._wrist[number]
        if self._over[part].tolist() != over:
            self._over[part] = over
            self._release[part] = [_least_over(RELEASED * threshold) for threshold in thresholds]
            self._plan()

    def driven(self, number: int, motor: Motor) -> None:
        index, memory = self._axis[number], motor.memory
        train = memory.train, memory.began, memory.pulses
        self._motors[index] = motor
        if self._trains[index] != train:
            self._trains[index], self._fields[index] = train, self._field(index, motor)
            self._plan()

    def _field(self, index: int, motor: Motor) -> Field:
        """Return the positions of a motor's field in the present physics step and in all later steps."""
        return _field(motor, self._step)

    def resumed(self) -> None:
        self._step = self._first = round(self.bench.now / float(self.bench.tick))
        self._strained = any(hold < 1 for hold in self.memory.holds)
        self._trains, self._known = [()] * self._n, self.memory.levels + bytes(self._all - self._levels)
        self._plan()

    # -- truth, for a referee --------------------------------------------------------------------------------

    @property
    def places(self) -> Array:
        """True position of each axis (steps from its low switch, shape (axes,))."""
        return np.asarray((self.bench.data.qpos[self._q] - self._low) / STEP)

    @property
    def counting(self) -> tuple[bool, ...]:
        """One value for each axis: False while the axis searches for the end of its rail. Later, the axis counts its
        steps from this end.
        """
        return tuple(motor is not None and motor.memory.state in COUNTING for motor in self._motors)

    @property
    def felt(self) -> Array:
        """The force that now acts on the wrists along each axis (N, shape (axes,))."""
        return self._sense()[: self._n].copy()

    @property
    def period(self) -> ServoPeriod:
        """The present state of the arms for traces and pictures: positions and speeds of the joints, and forces
        on the wrists.
        """
        data, felt = self.bench.data, self.felt.tolist()
        channels = {
            channel: tuple(felt[part])
            for channel, part in zip(self.channels, self._wrist.values(), strict=True)
        }
        sensed = Sensed(
            time=self.bench.now,
            q=data.qpos[self._q],
            qd=data.qvel[self._qd],
            gap=float(data.ten_length[0]),
            channels=channels,
        )
        return ServoPeriod(sensed=sensed, effort=data.actuator_force[: self._n].copy())

    # -- time ----------------------------------------------------------------------------------------------

    def advance(self, at: int) -> tuple[int, list[Level]] | None:
        steps = at // TICK - self._step
        if steps <= 0:
            return None
        self.bench.advance(steps / 1000)
        self.memory.peaks = np.maximum(self.memory.peaks, self._peaks.reshape(2, -1).max(axis=0)).tolist()
        self._peaks[:] = 0
        if not self._seen:
            return None
        seen, self._seen = [*self._seen.values()], {}
        return self._step * TICK, seen

    def _plan(self) -> None:
        """Put the positions of the magnetic fields of all motors in one table, with a row for each physics step from
        the present one on.
        """
        self._first, self._row = self._step, -1
        left = [(field, min(self._step - field.first, len(field.places) - 1)) for field in self._fields]
        rows = max(len(field.places) - gone for field, gone in left)
        self._whole, rows = rows <= _AHEAD, min(rows, _AHEAD)
        self._last = rows - 1
        places, speeds = np.empty((rows, self._n)), np.zeros((rows, self._n))
        for index, (field, gone) in enumerate(left):
            there = min(len(field.places) - gone, rows)
            places[:there, index], places[there:, index] = field.places[gone : gone + there], field.places[-1]
            speeds[:there, index] = field.speeds[gone : gone + there]
        places = (places + POLE * np.array(self.memory.slipped)) * STEP + self._begin
        pull = self._pulls(speeds)
        self._ctrl = np.empty((rows, self._servos))
        self._ctrl[:, : self._n] = places + self._lead * speeds * STEP
        self._ctrl[:, self._n :] = [0.0 if closed else OPEN for closed in self.memory.grips]
        self._ranges = np.empty((rows, self._n, 2))
        self._ranges[:, :, 0], self._ranges[:, :, 1] = -pull, pull
        strains = np.maximum(STEP, pull / self._stiff)  # m: lag above which a pole holds less
        over, under, high, low = np.frombuffer(self.memory.levels, bool).reshape(
            self._levels // self._n, self._n
        )
        force = np.where(over | under, self._release, self._over)  # a force may reverse within a step
        ends = self._high - DIFFERENTIAL * high, DIFFERENTIAL * ~low - self._low
        self._limits = np.empty((rows, self._all))
        self._limits[:, : self._levels] = np.concatenate((force, force, *ends))
        self._limits[:, self._places], self._limits[:, self._places.stop :] = (
            places + strains,
            strains - places,
        )

    def _pulls(self, speeds: Table) -> Table:
        """Return the greatest force of each motor (N) at these speeds (steps/s)."""
        return pull_out(speeds) * self._pull

    def _sense(self) -> Array:
        """Return the values that are compared with the limits. The array is overwritten at the next call."""
        np.matmul(self._felt, self.bench.data.sensordata, out=self._sensed)
        self._sensed += self._still
        return self._sensed

    def _draw(self) -> None:
        """Let the fields pull the rotors for one physics step."""
        if not self._whole and self._step - self._first > self._last:
            self._plan()
        row = min(self._step - self._first, self._last)
        if row == self._row and not (self._strained or self._reduced):
            return  # all fields stand still
        self._row, self._reduced = row, self._strained
        self.bench.data.ctrl[: self._servos] = self._ctrl[row]
        self.bench.model.actuator_forcerange[: self._n] = self._ranges[row]
        if self._strained:
            self.bench.model.actuator_forcerange[: self._n] *= np.array(self.memory.holds)[:, np.newaxis]

    def _look(self) -> None:
        """Detect what a physics step has changed."""
        sensed = self._sense()
        self._step += 1
        np.maximum(self._peaks, sensed[: 2 * self._n], out=self._peaks)
        levels = (sensed > self._limits[self._row]).tobytes()
        if levels != self._known or self._strained:
            self._change(levels, sensed)

    def _change(self, levels: bytes, sensed: Array) -> None:
        """Handle changes of comparators and switches, and rotors that leave their poles."""
        for index in range(self._levels):
            if levels[index] != self._known[index]:
                kind, axis = divmod(index, self._n)
                pin: Pin = ENDS.get(kind, "force")
                name = self.rig.axes[axis]
                number = LINE_NUMBERS[f"FORCE{name[1]}" if pin == "force" else name]
                self._seen[number, pin] = Level(number, pin, bool(levels[index]))
        if self._strained or any(levels[self._levels :]):
            self._strain(sensed[self._places])
        if levels[: self._levels] != self.memory.levels:
            self.memory.levels = levels[: self._levels]
            self._known = self.memory.levels + bytes(self._all - self._levels)
            self._plan()  # a switch that has acted is released at another place
        if self._seen:
            self.bench.end_early()

    def _strain(self, places: Array) -> None:
        """Reduce the force of each pole as its rotor moves away from the pole. Beyond half a pole, the next pole
        catches the rotor."""
        most, least = np.split(self._limits[self._row, self._levels :], 2)
        lags, begins = (places - (most - least) / 2) / STEP, (most + least) / 2 / STEP
        ends = np.maximum(POLE / 2, begins + 1)
        slips = np.abs(lags) >= ends
        self.memory.holds = _hold(lags, begins, ends).tolist()
        self._strained = any(hold < 1 for hold in self.memory.holds)
        if slips.any():
            poles = np.sign(lags) * np.maximum(1, np.rint(np.abs(lags) / POLE)) * slips
            self.memory.slipped = [
                was + int(more) for was, more in zip(self.memory.slipped, poles, strict=True)
            ]
            self.memory.holds = _hold(lags - POLE * poles, begins, ends).tolist()
            self._plan()


def _hold(lags: Array, begins: Array, ends: Array) -> Array:
    """Return, for each rotor, the fraction of the pull-out force with which the pole holds the rotor. This fraction is
    computed from the rotor's lag (steps).
    """
    return np.cos(np.clip((np.abs(lags) - begins) / (ends - begins), 0.0, 1.0) * math.pi / 2)


def _field(motor: Motor, first: int) -> Field:
    """Return the positions and speeds of a motor's field from the physics step `first` on."""
    memory = motor.memory
    if memory.train is None:
        return Field(first, np.array([float(memory.pulses)]), np.zeros(1))
    pulses, tick = memory.train.pulses, motor.crystal.ticks(2) / 2
    last = -(-(memory.began + motor.crystal.ticks(pulses.end)) // TICK) + 1
    ticks = (np.arange(first, max(first, last) + 1) * TICK - memory.began) / tick
    made = np.interp(ticks, np.concatenate(([0], pulses.ticks)), np.arange(len(pulses) + 1.0))
    places = memory.pulses + memory.sense * made
    return Field(first, places, np.append(np.diff(places) * 1000, 0.0))


def pull_out(speeds: Table) -> Table:
    """Return the greatest force of a motor (N) at these speeds (steps/s)."""
    usual, slow, fast = Drive(mass=1.0), CURVES[1].start, CURVES[1].top
    return np.asarray(np.interp(np.abs(speeds), (slow, fast), (usual.start_force, usual.top_force)))


def _least_over(threshold: float) -> float:
    """Return the least force (N) whose reading exceeds a threshold (N)."""
    return (math.floor(threshold / CONVERTER_N + 1e-9) + 0.5) * CONVERTER_N


def _sensors(model: mujoco.MjModel, kind: mujoco.mjtSensor, names: Sequence[str]) -> list[int]:
    """For each of the joints or sites in `names`, return the address of its reading."""
    of = model.site if kind == mujoco.mjtSensor.mjSENS_ACCELEROMETER else model.joint
    known = {
        int(model.sensor_objid[index]): int(model.sensor_adr[index])
        for index in range(model.nsensor)
        if model.sensor_type[index] == kind
    }
    return [known[of(name).id] for name in names]


def _gauges(model: mujoco.MjModel, rig: Rig, gain: Array, left: float) -> tuple[Table, Array]:
    """Return a matrix, shape (axes, readings), and an offset, shape (axes,). They convert the readings of the scene's
    sensors to the force along each axis. An axis without a wrist has the force 0.

    A strain gauge measures the force in the wrist. A part of this force accelerates the hand itself. The signal of an
    accelerometer cancels this part, so that the sum of both signals is the external force. A fraction of the force of
    acceleration remains uncorrected. `left` is this fraction.
    """
    size, wrists = len(rig.axes), [f"wrist_{axis}" for axis in rig.wrists]
    bent = _sensors(model, mujoco.mjtSensor.mjSENS_JOINTPOS, wrists)
    bending = _sensors(model, mujoco.mjtSensor.mjSENS_JOINTVEL, wrists)
    first = _sensors(model, mujoco.mjtSensor.mjSENS_ACCELEROMETER, [f"hand_{arm}" for arm in rig.arms])
    inertia = (1 - left) * _HAND_KG * np.resize(_SENSE, len(wrists))
    gauges, still = np.zeros((size, model.nsensordata)), np.zeros(size)
    for axis in range(len(wrists)):
        arm, component = divmod(axis, len(COMPONENTS))
        gauges[axis, bent[axis]] = gain[axis] * _STIFFNESS
        gauges[axis, bending[axis]] = gain[axis] * _DAMPING
        gauges[axis, first[arm] + component] = inertia[axis]
    upright = np.tile([0.0, 0.0, 1.0], len(rig.arms))
    still[: len(wrists)] = -inertia * upright * _GRAVITY
    return gauges, still
