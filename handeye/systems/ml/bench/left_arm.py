"""The left arm: a Purbrick arm beside the rectilinear arm, with a platter of its own. The positive directions of its
joints are those of the right arm: z points down, and y points away from the base.
"""

from dataclasses import replace
from typing import Final

import mujoco
import numpy as np

from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchAxes
from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadFile, NoSuchName
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.machines.purbrick import PURBRICK
from handeye.ports.axes import Axes, AxesReading, AxisSpec, Channel
from handeye.systems.ml.machine.rectilinear import INTERLOCKS, LEFT, axes_of
from handeye.systems.ml.machine.spec import CYCLE

PREFIX: Final = "purbrick_"
TOUCH: Final = Channel(name="touch")
_JOINTS: Final = {"opening": "hand"}  # of the motors whose joint or tendon has another name
_PLACE: Final = (0.95, 0.0, 0.0)  # m, of the middle of its platter
_HIGH: Final = 0.15  # m, the tips of the fingers over the platter where the motor of z is at 0
_TOUCHED: Final = 1.0  # N on the finger that close its switch
_HAND: Final = replace(PURBRICK.hand, name="opening")
AXES: Final = tuple(
    replace(axis, force=_HAND.force) if axis.name == _HAND.name else axis for axis in axes_of(LEFT)
)


def add_left_arm(spec: mujoco.MjSpec) -> None:
    """Add the arm and its table to the scene of the right arm, and move the camera back, so that it sees both arms."""
    arm = PURBRICK.scene()
    for name in ("floor", "wall"):
        arm.delete(arm.geom(name))
    for each in (*arm.lights, *arm.cameras):
        arm.delete(each)
    arm.option.impratio = spec.option.impratio  # both arms use that of the right arm
    column = arm.body("column")
    column.pos[2] += _HIGH
    arm.joint("z").range[:] = [-_HIGH, _HIGH]
    for name in ("z", "y", "roll"):
        arm.joint(name).axis[:] *= -1
    for x in (-1, 1):
        for y in (-1, 1):
            foot = arm.worldbody.add_geom(
                type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.02, 0.02, 0.36], pos=[0.2 * x, 0.2 * y, -0.39], group=2,
                rgba=[0.30, 0.31, 0.33, 1], mass=0,
            )  # fmt: skip
            foot.contype = foot.conaffinity = 0
    beam = arm.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.03, 0.6, 0.05], pos=[0, 0.63, 0.47], group=2, mass=0,
        rgba=[0.50, 0.58, 0.74, 1],
    )  # fmt: skip
    beam.contype = beam.conaffinity = 0
    spec.attach(arm, prefix=PREFIX, frame=spec.worldbody.add_frame(pos=[*_PLACE]))
    camera = spec.camera("people")
    camera.pos[:] = [0.35, -2.1, 1.15]
    camera.alt.xyaxes[:] = [0.999, -0.033, 0, 0.015, 0.44, 0.898]
    camera.fovy = 38


class LeftState(Record, frozen=True, kw_only=True):
    """The state of the arm, without the state of its servos."""

    signalled: tuple[str, ...] = ()  # interlocks that are on


class LeftArm(Axes, Mechanism[LeftState]):
    """The arm with the switch in its finger."""

    name, kind = "left_arm", LeftState
    specs: tuple[AxisSpec, ...] = AXES
    channels = (TOUCH, *(Channel(name=name) for name in INTERLOCKS))
    period = CYCLE * LEFT.every

    def __init__(self, bench: Bench) -> None:
        """Find the arm in the scene of a bench. The power of the arm is off."""
        named = [replace(spec, name=f"{PREFIX}{_JOINTS.get(spec.name, spec.name)}") for spec in AXES]
        self._servos = BenchAxes(
            bench, named, period=self.period, name="left_servos", channels={TOUCH: _touched}
        )
        self._servos.power(on=False)
        self._signalled = tuple[str, ...]()
        bench.add(self)

    def read(self) -> AxesReading:
        reading = self._servos.read()
        felt = dict.fromkeys(INTERLOCKS, 0.0) | dict.fromkeys(self._signalled, 1.0)
        return AxesReading(time=reading.time, q=reading.q, channels={**felt, **reading.channels})

    def put(self, goal: Array) -> None:
        self._servos.put(goal)

    def power(self, on: bool) -> None:
        self._servos.power(on)

    def signal(self, interlock: str, *, on: bool = True) -> None:
        """Switch the signal of an interlock on or off. In a real room, a person or a device would switch it."""
        if interlock not in INTERLOCKS:
            raise NoSuchName(f"there is no interlock {interlock}; the interlocks are {', '.join(INTERLOCKS)}")
        self._signalled = tuple(sorted({*self._signalled} - {interlock} | ({interlock} if on else set())))

    def bind(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Do nothing: the servos find their joints themselves."""

    def state(self) -> LeftState:
        return LeftState(signalled=self._signalled)

    def check(self, state: LeftState) -> None:
        if not {*state.signalled} <= {*INTERLOCKS}:
            raise BadFile("the saved left arm has an interlock that this arm does not have")

    def restore(self, state: LeftState) -> None:
        self._signalled = state.signalled


def _touched(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Return 1 if the finger with the sensor touches something, otherwise 0."""
    force = float(np.linalg.norm(data.sensor(f"{PREFIX}{PURBRICK.force_sensor}").data))
    return np.array([float(force > _TOUCHED)])
