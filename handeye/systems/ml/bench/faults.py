"""Faults of the rectilinear arm: stuck sensors, and dead, slow or weak motors. The jobs declare the faults of parts."""

from dataclasses import replace
from typing import Final

import mujoco
import numpy as np

from handeye.cell.bench import Bench
from handeye.core.faults import ExpectedDetection, FaultKind, Size
from handeye.core.pose import Array
from handeye.ports.axes import AxesReading
from handeye.systems.ml.bench.arm import AXES, RANGED, RectilinearArm
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.machine.rectilinear import RIGHT, STRAINS
from handeye.systems.ml.machine.spec import CYCLE

_NUMBERS: Final = {motor.axis: motor.number for motor in RIGHT.motors}
_FIXED: Final[dict[str, dict[str, float]]] = {
    "wand.open": {"wand": 0.0},
    "wand.closed": {"wand": 1.0},
    "gauge.left.z.dead": {"left_strain_z": 0.0},
    "gauge.left.y.dead": {"left_strain_y": 0.0},
    "gauges.dead": dict.fromkeys(STRAINS, 0.0),
    "range.silent": {"range": RANGED},
    "current.dead": {"torque": 0.0},
}
"""For each fault of a sensor: the channels that it affects, and the constant value that they read."""
_MEANINGS: Final = {
    "wand.open": "The switch of the wand is stuck open: the wand never signals a touch.",
    "wand.closed": "The switch of the wand is stuck closed: the wand always signals a touch.",
    "gauge.left.z.dead": "In the left finger, the gauge for vertical forces reads 0.",
    "gauge.left.y.dead": "In the left finger, the gauge for forces across the hand reads 0.",
    "gauges.dead": "The amplifier of the strain gauges has failed: all six read 0.",
    "range.silent": "The range finder hears no echo, and reads its greatest range.",
    "range.frozen": "The range finder repeats its first reading.",
    "current.dead": "The current of the screwdriver reads 0.",
}


def arm_fault(name: str, *calls: str, harmless: str = "") -> FaultKind:
    """Declare a fault of the arm.

    Args:
        calls: the messages that name the fault. For a fault of a motor or a potentiometer, the message that the motor
            does not reach its goal is added.
        harmless: why the work can succeed despite the fault; empty if the program must notice the fault.
    """
    kind, axis, what = [*name.split("."), "", ""][:3]
    if kind in ("motor", "potentiometer"):
        late = f"motor {_NUMBERS[axis]} ({axis}) does not reach its goal"
        meanings = {
            "dead": f"The motor of {axis} stays where it was when the power came on.",
            "slow": f"The motor of {axis} reaches only this share of its greatest speed.",
            "weak": f"The motor of {axis} has only this share of its force.",
            "stuck": f"The potentiometer of {axis} repeats its first reading.",
        }
        size = Size(unit="", usual=0.1, limits=(0.001, 1.0)) if what in ("slow", "weak") else None
        return planted(name, meanings[what], late, *calls, harmless=harmless, size=size)
    return planted(name, _MEANINGS[name], *calls, harmless=harmless)


def planted(name: str, meaning: str, *calls: str, harmless: str = "", size: Size | None = None) -> FaultKind:
    """Declare a fault that is present from the start.

    Args:
        calls: the messages that name the fault.
        harmless: why the work can succeed despite the fault; empty if the program must notice the fault.
    """
    expected = ExpectedDetection(calls=calls, harmless=harmless)
    return FaultKind(name=name, meaning=meaning, size=size, when="before", expected=expected)


def put_away(spec: mujoco.MjSpec, name: str) -> None:
    """Put a body where nothing touches it: under the floor, without weight."""
    body = spec.body(name)
    body.pos[2], body.gravcomp = -2.0, 1.0
    for geom in body.geoms:
        geom.contype = geom.conaffinity = 0


def arm_of(bench: Bench, world: ArmWorld) -> RectilinearArm:
    """Return the arm of a world, with its faults."""
    arms = ("motor", "potentiometer", "wand", "gauge", "gauges", "range", "current")
    faults = () if world.spec is None else world.spec.faults
    faulty = any(fault.name.partition(".")[0] in arms for fault in faults)
    return FaultyArm(bench, world) if faulty else RectilinearArm(bench, world)


class FaultyArm(RectilinearArm):
    """The arm with faults."""

    def __init__(self, bench: Bench, world: ArmWorld) -> None:
        self._fixed = dict[str, float]()
        self._stuck = self._dead = np.zeros(len(AXES), dtype=bool)
        self._paces = np.full(len(AXES), np.inf)
        weak = [world.fault(f"motor.{spec.name}.weak") or 1.0 for spec in AXES]
        self.specs = tuple(
            replace(spec, force=spec.force * share) if spec.force is not None else spec
            for spec, share in zip(AXES, weak, strict=True)
        )
        super().__init__(bench, world)
        first = super().read()
        self._first = first.q
        for name, fixed in _FIXED.items():
            if world.fault(name) is not None:
                self._fixed |= fixed
        if world.fault("range.frozen") is not None:
            self._fixed["range"] = first.channels["range"]
        self._dead = np.array([world.fault(f"motor.{spec.name}.dead") is not None for spec in AXES])
        self._stuck = np.array([world.fault(f"potentiometer.{spec.name}.stuck") is not None for spec in AXES])
        slow = [world.fault(f"motor.{spec.name}.slow") or np.inf for spec in AXES]
        self._paces = np.array([share * spec.speed * CYCLE for spec, share in zip(AXES, slow, strict=True)])
        self._last = None

    def read(self) -> AxesReading:
        reading = super().read()
        if not self._stuck.any():
            return reading
        return AxesReading(
            time=reading.time, q=np.where(self._stuck, self._first, reading.q), channels=reading.channels
        )

    def put(self, goal: Array) -> None:
        here = super().read().q
        goal = np.where(np.isfinite(self._paces), np.clip(goal, here - self._paces, here + self._paces), goal)
        super().put(np.where(self._dead, self._first, goal))

    def _felt(self, time: float) -> dict[str, float]:
        return super()._felt(time) | self._fixed
