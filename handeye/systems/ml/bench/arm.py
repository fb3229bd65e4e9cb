"""The rectilinear arm on a bench, with a wand, strain gauges, a range finder, switches, and inaccurate potentiometers.

A slide does not stop at exactly the same place each time. To simulate this, the slide's potentiometer has an error,
which is random and differs from motion to motion. When the slide stops, the reading agrees with the goal, but the
slide is elsewhere.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import cos, sin
from typing import Final

import mujoco
import numpy as np

from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchAxes
from handeye.cell.mechanism import Mechanism, scene_for
from handeye.core.errors import BadFile, NoSuchName
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.execution.servo import ServoPeriod
from handeye.ports.axes import Axes, AxesReading, AxisSpec, Channel
from handeye.ports.workcell import Sensed
from handeye.systems.ml.bench import world as drawn
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.machine.rectilinear import INTERLOCKS, RIGHT, axes_of
from handeye.systems.ml.machine.spec import CYCLE, GRAM_FORCE

_FORCES: Final = {"base": 3000.0, "z": 2500.0, "y": 1600.0, "x": 1000.0, "separation": 90.0}  # N and N m
AXES: Final = tuple(replace(axis, force=_FORCES.get(axis.name)) for axis in axes_of(RIGHT))
WAND: Final = Channel(name="wand")
STRAINS: Final = tuple(Channel(name=f"{side}_strain", unit="N", width=3) for side in ("left", "right"))
RANGE: Final = Channel(name="range", unit="m")
TORQUE: Final = Channel(name="torque", unit="N m")
INSIDE: Final = tuple(Channel(name=f"inside_{side}") for side in ("left", "right"))
SIGNALS: Final = 0.0001  # m by which the tip of the wand is bent when it signals a contact
PROBE: Final = 0.03  # m, length of the wand
RANGED: Final = 0.5  # m: reach of the range finder
_PINGS: Final = 5  # cycles from one sound of the range finder to the next
STRAINED: Final = 1500 * GRAM_FORCE  # N: the greatest force that a gauge shows
RESOLVED: Final = 5 * GRAM_FORCE  # N: one step of a gauge's converter
FINGER_STIFFNESS: Final = 10_000.0  # N/m along y and z
_STIFF: Final = np.array(
    [100_000.0, FINGER_STIFFNESS, FINGER_STIFFNESS] * 2
)  # N/m of the fingers along x, y and z
_PRESSED: Final = 0.2  # N: force that closes a switch inside a finger
_SLIDES: Final = slice(1, 4)
_SLIDE_NAMES: Final = tuple(spec.name for spec in AXES[_SLIDES])
_WAVE: Final = np.array([0.1 if spec.kind == "prismatic" else 1.0 for spec in AXES])
"""Travel after which a potentiometer's error repeats, in m for a slide and in rad for a rotation."""
_NOISES: Final = 4093  # cycles after which the noise repeats
_STRAIN_PARTS: Final = tuple(part for channel in STRAINS for part in channel.parts)


class Onset(Record, frozen=True, kw_only=True):
    """What the arm read at the moment when a fault began."""

    fault: str
    q: tuple[float, ...]  # positions of the axes, SI units
    ranged: float  # m


class ArmState(Record, frozen=True, kw_only=True):
    """The state of the arm, without the state of its servos."""

    goal: tuple[float, ...]  # last goals of the three slides, m
    ways: tuple[int, ...]  # directions in which these goals have moved: -1, 0 or 1
    motions: tuple[int, ...]  # motions that the slides have begun
    offsets: tuple[float, ...]  # m: errors of the slides in their present motions
    ranged: float = 0.0  # m: the last measured range
    signalled: tuple[str, ...] = ()  # interlocks that are on
    onsets: tuple[Onset, ...] = ()  # the faults that have begun


class RectilinearArm(Axes, Mechanism[ArmState]):
    """The arm with its sensors."""

    name = "arm"
    kind = ArmState
    specs: tuple[AxisSpec, ...] = AXES
    channels = (WAND, *STRAINS, RANGE, TORQUE, *INSIDE, *(Channel(name=name) for name in INTERLOCKS))
    period = CYCLE

    def __init__(self, bench: Bench, world: ArmWorld) -> None:
        """Put the arm in the scene of a bench. The arm's pump is off."""
        self._bench, self._world = bench, world
        self._width = world.value(drawn.REPEATABILITY)
        self._offsets = np.zeros(len(AXES))
        sigmas = [drawn.SLIDES if spec.kind == "prismatic" else drawn.TURNS for spec in AXES]
        self._bends = np.array(
            [world.normal(f"bend.{spec.name}", sigma) for spec, sigma in zip(AXES, sigmas, strict=True)]
        )
        self._phases = np.array([world.numbers(f"phase.{spec.name}").uniform(0, 2 * np.pi) for spec in AXES])
        self._gains = _STIFF * [1 + world.normal(f"gain.{part}", drawn.GAIN) for part in _STRAIN_PARTS]
        self._zeros = np.array([world.normal(f"zero.{part}", drawn.ZERO) for part in _STRAIN_PARTS])
        self._drifts = np.array([world.normal(f"drift.{part}", drawn.DRIFT) for part in _STRAIN_PARTS]) / 60
        sigma = [*len(_STRAIN_PARTS) * (world.value(drawn.NOISE),), world.value(drawn.RANGE)]
        self._noise = world.numbers("noise").standard_normal((_NOISES, len(sigma))) * sigma
        self._signals = SIGNALS + world.normal("wand.threshold", drawn.THRESHOLD)
        self._rays = _cone(world.value(drawn.CONE))
        self._range, self._signalled = RANGED, tuple[str, ...]()
        self._last: AxesReading | None = None
        self.torque: Callable[[int], float] = lambda _: 0.0
        """Function that takes the number of a cycle and returns the torque of the power tool (N m), as indicated by
        the tool's motor current.
        """
        self._servos = BenchAxes(bench, self.specs, period=CYCLE, name="servos", bent=self._bent)
        self._servos.power(on=False)
        self._goal = self._servos.read().q[_SLIDES]
        self._ways, self._motions = np.zeros(len(self._goal)), [0] * len(self._goal)
        self.bind(bench.model, bench.data)
        bench.add(self)

    @scene_for("a rectilinear arm")
    def bind(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Find the parts of the arm in a scene. A scene without a wand is allowed."""
        at = [int(model.sensor(part).adr[0]) for part in _sensor_names()]
        self._gauges, self._switches = at[:-2], at[-2:]
        wand = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) for name in ("wand_x", "wand_y")]
        self._wand = [int(model.jnt_qposadr[joint]) for joint in wand if joint >= 0]
        joints = [model.joint(spec.name) for spec in AXES[:-2]]
        self._qd = [int(joint.dofadr[0]) for joint in joints]
        self._eye, self._hand = model.site("range").id, model.body("hand").id
        self._met = np.zeros(len(self._rays), dtype=np.int32), np.zeros(len(self._rays))

    # -- port ------------------------------------------------------------------------------------------

    def read(self) -> AxesReading:
        if self._last is None or self._last.time != self._bench.now:
            reading = self._servos.read()
            self._last = AxesReading(time=reading.time, q=reading.q, channels=self._felt(reading.time))
        return self._last

    def put(self, goal: Array) -> None:
        ahead = goal[_SLIDES] - self._goal if np.shape(goal) == (len(AXES),) else self._ways
        ways = np.sign(np.round(ahead, 9))
        if self._width and ((ways != 0) & (ways != self._ways)).any():
            for slide in np.flatnonzero((ways != 0) & (ways != self._ways)):
                self._motions[slide] += 1
                self._offset(int(slide))
        self._servos.put(goal)
        self._goal, self._ways = goal[_SLIDES].copy(), ways

    def power(self, on: bool) -> None:
        self._servos.power(on)

    def signal(self, interlock: str, *, on: bool = True) -> None:
        """Switch the signal of an interlock on or off, as a person or a device of the room does."""
        if interlock not in INTERLOCKS:
            raise NoSuchName(f"there is no interlock {interlock}; the interlocks are {', '.join(INTERLOCKS)}")
        self._last = None
        self._signalled = tuple(sorted({*self._signalled} - {interlock} | ({interlock} if on else set())))

    def _felt(self, time: float) -> dict[str, float]:
        """Return what each sensor and interlock reads. The keys are the names of the sensors and interlocks."""
        data = self._bench.data
        cycle = round(time / CYCLE)
        noise = self._noise[cycle % _NOISES]
        if cycle % _PINGS == 0:
            self._range = min(max(self._ranged() + float(noise[-1]), 0.0), RANGED)
        strain = -self._gains * data.sensordata[self._gauges] + self._zeros + self._drifts * time + noise[:-1]
        strain = np.clip(np.rint(strain / RESOLVED) * RESOLVED, -STRAINED, STRAINED)
        felt = dict.fromkeys(INTERLOCKS, 0.0) | dict.fromkeys(self._signalled, 1.0)
        felt.update(zip(_STRAIN_PARTS, strain.tolist(), strict=True))
        left, right = data.sensordata[self._switches] > _PRESSED
        felt["inside_left"], felt["inside_right"] = float(left), float(right)
        felt["wand"] = float(PROBE * float(np.linalg.norm(data.qpos[self._wand])) > self._signals)
        felt["range"] = self._range
        felt["torque"] = self.torque(cycle)
        return felt

    def _ranged(self) -> float:
        """Return the distance (m) of the nearest object in the cone of the range finder."""
        model, data, (met, far) = self._bench.model, self._bench.data, self._met
        ways = self._rays @ data.site_xmat[self._eye].reshape(3, 3).T
        at = data.site_xpos[self._eye]
        mujoco.mj_multiRay(
            model, data, at, ways.ravel(), None, True, self._hand, met, far, None, len(far), RANGED
        )
        return float(np.min(far, initial=RANGED, where=far >= 0))

    # -- potentiometers --------------------------------------------------------------------------------

    def _bent(self, q: Array) -> Array:
        """Return the differences between the true positions and the positions that the potentiometers show."""
        return np.asarray(self._bends * np.sin(2 * np.pi * q / _WAVE + self._phases) + self._offsets)

    def _offset(self, slide: int) -> None:
        """Draw the random error that a slide has during its present motion."""
        name = f"repeatability.{_SLIDE_NAMES[slide]}.{self._motions[slide]}"
        self._offsets[_SLIDES][slide] = self._width * self._world.numbers(name).uniform(-0.5, 0.5)

    # -- for traces ------------------------------------------------------------------------------------

    @property
    def servo_period(self) -> ServoPeriod:
        """The present joint positions, forces and readings of the arm, for traces and pictures."""
        data, reading = self._bench.data, self.read()
        channels = {channel: tuple(reading.channels[p] for p in channel.parts) for channel in self.traced}
        sensed = Sensed(
            time=reading.time,
            q=reading.q[:-2],
            qd=data.qvel[self._qd],
            gap=float(data.ten_length[0]),
            channels=channels,
        )
        return ServoPeriod(sensed=sensed, effort=data.actuator_force[: len(AXES) - 2].copy())

    traced: Sequence[Channel] = (WAND, *STRAINS, RANGE, TORQUE)
    joints: Mapping[str, str] = {spec.name: spec.kind for spec in AXES[:-2]}

    # -- state -----------------------------------------------------------------------------------------

    def state(self) -> ArmState:
        return ArmState(
            goal=tuple(self._goal.tolist()),
            ways=tuple(int(way) for way in self._ways),
            motions=tuple(self._motions),
            offsets=tuple(self._offsets[_SLIDES].tolist()),
            ranged=self._range,
            signalled=self._signalled,
        )

    def check(self, state: ArmState) -> None:
        slides = (state.goal, state.ways, state.motions, state.offsets)
        if any(len(each) != len(_SLIDE_NAMES) for each in slides):
            raise BadFile("the saved state is the state of an arm with a different number of slides")
        if (
            not np.isfinite((*state.goal, *state.offsets, state.ranged)).all()
            or {*state.ways} - {-1, 0, 1}
            or min(state.motions) < 0
        ):
            raise BadFile("the saved state of the arm contains an impossible motion")
        if {*state.signalled} - {*INTERLOCKS}:
            raise BadFile("the saved arm has interlocks that this arm lacks")

    def restore(self, state: ArmState) -> None:
        self._goal, self._ways = np.array(state.goal), np.array(state.ways, dtype=float)
        self._motions, self._range, self._signalled = [*state.motions], state.ranged, state.signalled
        self._offsets[_SLIDES], self._last = state.offsets, None


def _sensor_names() -> tuple[str, ...]:
    fingers = [f"{side}_{axis}" for side in ("left", "right") for axis in "xyz"]
    return (*fingers, "inside_left", "inside_right")


def _cone(half: float) -> Array:
    """Return unit vectors, shape (13, 3): along the axis of a cone, along its surface, and halfway between."""
    ways = [(0.0, 0.0, -1.0)]
    for share, count in ((0.5, 4), (1.0, 8)):
        for turn in 2 * np.pi * np.arange(count) / count:
            ways.append((sin(share * half) * cos(turn), sin(share * half) * sin(turn), -cos(share * half)))
    return np.array(ways)
