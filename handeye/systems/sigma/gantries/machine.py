"""Simulates the two gantries that are connected to the pins: rotors that magnetic fields pull along, wrists
that bend, switches, light beams and hands.

The fields of all motors are computed in advance from the pulse trains of their firmware, as tables with one row
per millisecond. The physics follows these tables. In each millisecond, one matrix product and one comparison
show whether a force on a wrist has crossed its threshold, a switch has changed, or a rotor has slipped. Only
then is other code executed.
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
from handeye.systems.sigma.protocol import AXES, COMPONENTS, DEVICES, NUMBERS

SCENE: Final = "supersigma/supersigma.xml"
CAMERA: Final = "people"
ARMS: Final = (1, 2)
SWITCHED_ON_AT: Final = 400  # steps from its low switch where the power finds each axis
FORCES: Final = tuple(Channel(name=f"force_{arm}", unit="N", width=3) for arm in ARMS)
FINGERS: Final = tuple(f"{side}_{arm}" for arm in ARMS for side in ("left", "right"))
DIFFERENTIAL: Final = 2e-4  # m by which a switch is released later than it acts
OPEN: Final = 0.044  # m between the fingers
TICK: Final = 1000 * PS  # of the physics, ps
_HAND_KG: Final = 1.2  # as the accelerometers are set
_STIFFNESS: Final = 20_000.0  # N/m of a wrist, as the strain gauges are set
_DAMPING: Final = 92.95  # N s/m
_GRAVITY: Final = 9.81
_SUNK: Final = 1e-3  # m by which the lamp lies in its finger, so that an object in the grip is before it
_FINGER: Final = 2e-4  # m by which a ray may end before the photodiode: it meets the other finger
_SENSE: Final = np.array([1.0, 1.0, -1.0, -1.0, 1.0, -1.0])  # of each axis along x, y or z of the scene
_AXIS: Final = {NUMBERS[axis]: index for index, axis in enumerate(AXES)}
_WRIST: Final = {NUMBERS[f"FORCE{arm}"]: slice(3 * index, 3 * index + 3) for index, arm in enumerate(ARMS)}
_WRISTED: Final = tuple(NUMBERS[f"FORCE{axis[1]}"] for axis in AXES)
_HAND: Final = {NUMBERS[f"HAND{arm}"]: index for index, arm in enumerate(ARMS)}
_N: Final = len(AXES)
_HIGH: Final = 2  # rows of six: forces one way and the other, high ends, low ends, rotors ahead, and behind
ENDS: Final[dict[int, Pin]] = {_HIGH: "high", _HIGH + 1: "low"}
_LEVELS: Final = 4 * _N
_ALL: Final = 6 * _N
_SERVOS: Final = _N + len(ARMS)  # a job may have more motors, which follow these
_AHEAD: Final = 256  # steps that are planned at once
_PLACES: Final = slice(_LEVELS, _LEVELS + _N)
Table = NDArray[np.float64]


def scene(world: GantryWorld) -> mujoco.MjSpec:
    """Return the scene of a world with an empty board."""
    spec = mujoco.MjSpec.from_file(str(scenes() / SCENE))
    stiffer = world.axes(STIFFNESS)
    friction = world.value(FRICTION)
    for index, axis in enumerate(AXES):
        spec.joint(axis).damping = np.array([friction * MASSES[axis[0]], 0, 0])
        spec.joint(f"wrist_{axis}").stiffness = np.array([_STIFFNESS * (1 + stiffer[index]), 0, 0])
    for arm in ARMS:
        higher = world.normal(f"beam.{arm}", BEAM)
        for end in ("lamp", "photodiode"):
            spec.site(f"{end}_{arm}").pos[2] += higher
    return spec


class Field(NamedTuple):
    """The position of a motor's magnetic field from a physics step on. The field stays at the last row."""

    first: int
    places: Table  # pulses
    speeds: Table  # pulses/s


class Gantries(Plant[GantryMemory]):
    """Two gantries on a bench."""

    predicts = False
    longest = 200_000
    channels = FORCES

    def __init__(self, spec: mujoco.MjSpec, world: GantryWorld, *, compensated: bool = True) -> None:
        """Switch the gantries on.

        Args:
            compensated: add the signals of the accelerometers to those of the wrists, so that the force that
                accelerates a hand is not counted.
        """
        self.bench, self.memory = Bench(spec.compile()), GantryMemory()
        self.actuated: list[Callable[[int, Sequence[int]], None]] = []
        """Called with the number and the outputs of a hand microcomputer when the outputs have changed."""
        assert self.bench.tick * 10**6 * PS == TICK
        model, data = self.bench.model, self.bench.data
        self._low = world.axes(SWITCHES)  # m, where the low switch of each axis is, of its joint
        self._high = self._low + [TRAVEL[axis[0]] * STEP for axis in AXES]
        self._begin = self._low + SWITCHED_ON_AT * STEP
        self._pull = 1.0 + world.axes(PULL_OUT)
        servos = [model.actuator(axis).id for axis in AXES]
        self._stiff = model.actuator_gainprm[servos, 0].copy()
        self._lead = -model.actuator_biasprm[servos, 2] / self._stiff  # s by which speed leads the place
        gauges, still = _gauges(1.0 + world.axes(GAIN), world.value(LEFT) if compensated else 1.0)
        places = np.eye(_N, model.nsensordata)
        self._felt = np.concatenate((gauges, -gauges, places, -places, places, -places))
        self._still = np.concatenate((still, -still, np.zeros(4 * _N)))
        self._over = np.full(_N, _least_over(STANDARD_N))
        self._release = np.full(_N, _least_over(STANDARD_N * RELEASED))
        self._trains: list[object] = [None] * _N
        self._motors: list[Motor | None] = [None] * _N
        self._fields = [Field(0, np.zeros(1), np.zeros(1))] * _N
        self._first = self._step = 0
        self._peaks = np.zeros(_N)
        self._seen: dict[tuple[int, Pin], Level] = {}
        joints = [model.joint(axis) for axis in AXES]
        self._q = [int(joint.qposadr[0]) for joint in joints]
        self._qd = [int(joint.dofadr[0]) for joint in joints]
        data.qpos[self._q] = self._begin
        for finger in FINGERS:
            data.qpos[model.joint(finger).qposadr[0]] = OPEN / 2
        mujoco.mj_forward(model, data)
        self._known, self._strained = bytes(_ALL), False
        self.memory.levels = self._known[:_LEVELS]
        self._plan()
        self.bench.before_step.append(self._draw)
        self.bench.after_step.append(self._look)

    # -- pins ----------------------------------------------------------------------------------------------

    def next_pin(self, number: int, motor: Motor) -> None:
        return None

    def forces(self, number: int) -> Sequence[float]:
        return [float(force) for force in self.felt[_WRIST[number]]]

    def peaks(self, number: int) -> Sequence[float]:
        part = _WRIST[number]
        peaks, self.memory.peaks[part] = self.memory.peaks[part], [0.0] * len(COMPONENTS)
        return peaks

    def beam(self, number: int) -> bool:
        model, data, arm = self.bench.model, self.bench.data, ARMS[_HAND[number]]
        way = -data.body(f"left_{arm}").xmat.reshape(3, 3)[:, 1]  # from the left finger to the right one
        lamp, photodiode = data.site(f"lamp_{arm}").xpos, data.site(f"photodiode_{arm}").xpos
        length = float((photodiode - lamp) @ way) + _SUNK
        body, met = model.body(f"left_{arm}").id, np.zeros(1, dtype=np.int32)
        far = mujoco.mj_ray(model, data, lamp - _SUNK * way, way, None, True, body, met)
        return bool(0 <= far < length - _FINGER)

    def actuate(self, number: int, devices: Sequence[int]) -> None:
        closed = bool(devices[DEVICES["HAND"]])
        if self.memory.grips[_HAND[number]] != closed:
            self.memory.grips[_HAND[number]] = closed
            self._plan()
        for act in self.actuated:
            act(number, devices)

    def limited(self, number: int, thresholds: Sequence[float]) -> None:
        over, part = [*map(_least_over, thresholds)], _WRIST[number]
        if self._over[part].tolist() != over:
            self._over[part] = over
            self._release[part] = [_least_over(RELEASED * threshold) for threshold in thresholds]
            self._plan()

    def driven(self, number: int, motor: Motor) -> None:
        index, memory = _AXIS[number], motor.memory
        train = memory.train, memory.began, memory.pulses
        self._motors[index] = motor
        if self._trains[index] != train:
            self._trains[index], self._fields[index] = train, self._field(index, motor)
            self._plan()

    def _field(self, index: int, motor: Motor) -> Field:
        """Return the position of a motor's field from now on."""
        return _field(motor, self._step)

    def resumed(self) -> None:
        self._step = self._first = round(self.bench.now / float(self.bench.tick))
        self._strained = any(hold < 1 for hold in self.memory.holds)
        self._trains, self._known = [()] * _N, self.memory.levels + bytes(_ALL - _LEVELS)
        self._plan()

    # -- truth, for a referee --------------------------------------------------------------------------------

    @property
    def places(self) -> Array:
        """True position of each axis (steps from its low switch, shape (6,))."""
        return np.asarray((self.bench.data.qpos[self._q] - self._low) / STEP)

    @property
    def counting(self) -> tuple[bool, ...]:
        """For each axis, False while it searches the end of its rail, because its count begins there."""
        return tuple(motor is not None and motor.memory.state in COUNTING for motor in self._motors)

    @property
    def felt(self) -> Array:
        """Present force on the wrists along each axis (N, shape (6,))."""
        return self._sense()[:_N]

    @property
    def period(self) -> ServoPeriod:
        """The present state of the arms for traces and pictures: positions and speeds of the joints, and forces
        on the wrists.
        """
        data, felt = self.bench.data, self.felt.tolist()
        channels = {channel: tuple(felt[part]) for channel, part in zip(FORCES, _WRIST.values(), strict=True)}
        sensed = Sensed(
            time=self.bench.now,
            q=data.qpos[self._q],
            qd=data.qvel[self._qd],
            gap=float(data.ten_length[0]),
            channels=channels,
        )
        return ServoPeriod(sensed=sensed, effort=data.actuator_force[:_N].copy())

    # -- time ----------------------------------------------------------------------------------------------

    def advance(self, at: int) -> tuple[int, list[Level]] | None:
        steps = at // TICK - self._step
        if steps <= 0:
            return None
        self.bench.advance(steps / 1000)
        self.memory.peaks = np.maximum(self.memory.peaks, self._peaks).tolist()
        self._peaks = np.zeros(_N)
        if not self._seen:
            return None
        seen, self._seen = [*self._seen.values()], {}
        return self._step * TICK, seen

    def _plan(self) -> None:
        """Combine the fields of all motors in one table, which begins at the present physics step."""
        self._first = self._step
        left = [(field, min(self._step - field.first, len(field.places) - 1)) for field in self._fields]
        rows = max(len(field.places) - gone for field, gone in left)
        self._whole, rows = rows <= _AHEAD, min(rows, _AHEAD)
        self._last = rows - 1
        places, speeds = np.empty((rows, _N)), np.zeros((rows, _N))
        for index, (field, gone) in enumerate(left):
            there = min(len(field.places) - gone, rows)
            places[:there, index], places[there:, index] = field.places[gone : gone + there], field.places[-1]
            speeds[:there, index] = field.speeds[gone : gone + there]
        places = (places + POLE * np.array(self.memory.slipped)) * STEP + self._begin
        pull = self._pulls(speeds)
        self._ctrl = np.empty((rows, _SERVOS))
        self._ctrl[:, :_N] = places + self._lead * speeds * STEP
        self._ctrl[:, _N:] = [0.0 if closed else OPEN for closed in self.memory.grips]
        self._ranges = np.empty((rows, _N, 2))
        self._ranges[:, :, 0], self._ranges[:, :, 1] = -pull, pull
        strains = np.maximum(STEP, pull / self._stiff)  # m of lag from which on a pole holds less
        over, under, high, low = np.frombuffer(self.memory.levels, bool).reshape(_LEVELS // _N, _N)
        force = np.where(over | under, self._release, self._over)  # a force may reverse within a step
        ends = self._high - DIFFERENTIAL * high, DIFFERENTIAL * ~low - self._low
        self._limits = np.empty((rows, _ALL))
        self._limits[:, :_LEVELS] = np.concatenate((force, force, *ends))
        self._limits[:, _PLACES], self._limits[:, _PLACES.stop :] = places + strains, strains - places

    def _pulls(self, speeds: Table) -> Table:
        """Return the greatest force of each motor (N) at these speeds (steps/s)."""
        return pull_out(speeds) * self._pull

    def _sense(self) -> Array:
        """Return the values that are compared with the limits."""
        return np.asarray(self._felt @ self.bench.data.sensordata + self._still)

    def _draw(self) -> None:
        """Let the fields pull the rotors for one physics step."""
        if not self._whole and self._step - self._first > self._last:
            self._plan()
        self._row = min(self._step - self._first, self._last)
        self.bench.data.ctrl[:_SERVOS] = self._ctrl[self._row]
        self.bench.model.actuator_forcerange[:_N] = self._ranges[self._row]
        if self._strained:
            self.bench.model.actuator_forcerange[:_N] *= np.array(self.memory.holds)[:, np.newaxis]

    def _look(self) -> None:
        """Detect what a physics step has changed."""
        sensed = self._sense()
        self._step += 1
        np.maximum(self._peaks, np.abs(sensed[:_N]), out=self._peaks)
        levels = (sensed > self._limits[self._row]).tobytes()
        if levels != self._known or self._strained:
            self._change(levels, sensed)

    def _change(self, levels: bytes, sensed: Array) -> None:
        """Handle changes of comparators and switches, and rotors that leave their poles."""
        for index in range(_LEVELS):
            if levels[index] != self._known[index]:
                kind, axis = divmod(index, _N)
                pin: Pin = ENDS.get(kind, "force")
                number = _WRISTED[axis] if pin == "force" else NUMBERS[AXES[axis]]
                self._seen[number, pin] = Level(number, pin, bool(levels[index]))
        if self._strained or any(levels[_LEVELS:]):
            self._strain(sensed[_PLACES])
        if levels[:_LEVELS] != self.memory.levels:
            self.memory.levels = levels[:_LEVELS]
            self._known = self.memory.levels + bytes(_ALL - _LEVELS)
            self._plan()  # what acts is released elsewhere
        if self._seen:
            self.bench.end_early()

    def _strain(self, places: Array) -> None:
        """Reduce the force of each pole with the distance of its rotor. Beyond half a pole, the next pole
        catches the rotor."""
        most, least = np.split(self._limits[self._row, _LEVELS:], 2)
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
    """Return the fraction of its pull-out force with which each pole holds its rotor, from the rotor's lag
    (steps)."""
    return np.cos(np.clip((np.abs(lags) - begins) / (ends - begins), 0.0, 1.0) * math.pi / 2)


def _field(motor: Motor, first: int) -> Field:
    """Return the position of a motor's field from a physics step on."""
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


def _gauges(gain: Array, left: float) -> tuple[Table, Array]:
    """Return the matrix, shape (6, 24), and the offset, shape (6,), that convert the readings of the scene's
    sensors to the six forces.

    A strain gauge measures the force in the wrist. The signal of an accelerometer corrects this for the force
    that accelerates the hand itself, so that the sum is the external force. A fraction `left` of the force of
    acceleration remains uncorrected.
    """
    inertia = (1 - left) * _HAND_KG * _SENSE
    gauges = np.zeros((_N, 4 * _N))
    for axis in range(_N):
        gauges[axis, _N + axis] = gain[axis] * _STIFFNESS
        gauges[axis, 2 * _N + axis] = gain[axis] * _DAMPING
        gauges[axis, 3 * _N + axis] = inertia[axis]
    upright = np.tile([0.0, 0.0, 1.0], len(ARMS))
    return gauges, -inertia * upright * _GRAVITY
