"""Faults of the rectilinear arm: stuck sensors, and dead, slow or weak motors. Faults of parts are declared by the
jobs that use these parts.
"""

from dataclasses import replace
from typing import Final, Literal

import mujoco
import numpy as np
from msgspec.structs import replace as with_fields

from handeye.cell.bench import Bench
from handeye.core.errors import BadFile
from handeye.core.faults import ExpectedDetection, FaultKind, Size
from handeye.core.pose import Array
from handeye.ports.axes import AxesReading
from handeye.systems.ml.bench.arm import AXES, RANGED, ArmState, Onset, RectilinearArm
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.machine.rectilinear import RIGHT, STRAINS
from handeye.systems.ml.machine.spec import CYCLE

_OF_THE_ARM: Final = ("motor", "potentiometer", "wand", "gauge", "gauges", "range", "current")
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
"""For each fault of a sensor: the channels that the fault affects, and the constant value that these channels read."""
_MEANINGS: Final = {
    "wand.open": "The switch of the wand is stuck open: the wand never signals a touch.",
    "wand.closed": "The switch of the wand is stuck closed: the wand always signals a touch.",
    "gauge.left.z.dead": "In the left finger, the gauge for vertical forces reads 0.",
    "gauge.left.y.dead": "In the left finger, the gauge for forces across the hand reads 0.",
    "gauges.dead": "The amplifier of the strain gauges has failed: all six read 0.",
    "range.silent": "The range finder hears no echo, and reads its greatest range.",
    "range.frozen": "The range finder repeats the reading that it had when the fault began.",
    "current.dead": "The current of the screwdriver reads 0.",
}


def arm_fault(name: str, *calls: str, harmless: str = "") -> FaultKind:
    """Declare a fault of the arm.

    Args:
        calls: the messages that name the fault. If the fault is in a motor or a potentiometer, this function adds the
            message "motor ... does not reach its goal".
        harmless: why the work can succeed despite the fault; empty if the program must notice the fault.
    """
    kind, axis, what = [*name.split("."), "", ""][:3]
    if kind in ("motor", "potentiometer"):
        late = f"motor {_NUMBERS[axis]} ({axis}) does not reach its goal"
        meanings = {
            "dead": f"The motor of {axis} stays where it was when the fault began.",
            "slow": f"The motor of {axis} reaches only this fraction of its greatest speed.",
            "weak": f"The motor of {axis} gives only this fraction of its full force.",
            "stuck": f"The potentiometer of {axis} repeats the reading that it had when the fault began.",
        }
        size = Size(unit="", usual=0.1, limits=(0.001, 1.0)) if what in ("slow", "weak") else None
        when: Literal["before", "later"] = "before" if what == "weak" else "later"
        return planted(name, meanings[what], late, *calls, harmless=harmless, size=size, when=when)
    return planted(name, _MEANINGS[name], *calls, harmless=harmless, when="later")


def planted(
    name: str, meaning: str, *calls: str, harmless: str = "", size: Size | None = None,
    when: Literal["before", "later"] = "before",
) -> FaultKind:  # fmt: skip
    """Declare a fault.

    Args:
        calls: the messages that name the fault.
        harmless: why the work can succeed despite the fault; empty if the program must notice the fault.
        when: `before` if the fault is present from the start; `later` if the fault can also begin some time after the
            start.
    """
    expected = ExpectedDetection(calls=calls, harmless=harmless)
    return FaultKind(name=name, meaning=meaning, size=size, when=when, expected=expected)


def put_away(spec: mujoco.MjSpec, name: str) -> None:
    """Put a body where nothing touches it: under the floor, without weight."""
    body = spec.body(name)
    body.pos[2], body.gravcomp = -2.0, 1.0
    for geom in body.geoms:
        geom.contype = geom.conaffinity = 0


def arm_of(bench: Bench, world: ArmWorld) -> RectilinearArm:
    """Return the arm of a world, with the faults that the world gives the arm."""
    faults = () if world.spec is None else world.spec.faults
    faulty = any(fault.name.partition(".")[0] in _OF_THE_ARM for fault in faults)
    return FaultyArm(bench, world) if faulty else RectilinearArm(bench, world)


class FaultyArm(RectilinearArm):
    """The arm with faults. Some faults are present from the start; others begin after a time."""

    def __init__(self, bench: Bench, world: ArmWorld) -> None:
        faults = () if world.spec is None else world.spec.faults
        self._faults = {fault.name: fault for fault in faults if fault.name.partition(".")[0] in _OF_THE_ARM}
        self._onsets = dict[str, Onset]()
        weak = [world.fault(f"motor.{spec.name}.weak") or 1.0 for spec in AXES]
        self.specs = tuple(
            replace(spec, force=spec.force * share) if spec.force is not None else spec
            for spec, share in zip(AXES, weak, strict=True)
        )
        super().__init__(bench, world)
        self.read()

    def _present(self, name: str) -> bool:
        """Return True if the arm has a fault, and the fault has begun."""
        fault = self._faults.get(name)
        return fault is not None and self._bench.now >= (fault.after or 0.0)

    def read(self) -> AxesReading:
        reading = super().read()
        if begun := [name for name in self._faults if name not in self._onsets and self._present(name)]:
            q, ranged = tuple(reading.q.tolist()), reading.channels["range"]
            self._onsets |= {name: Onset(fault=name, q=q, ranged=ranged) for name in begun}
            self._last = None  # read again, with the faults
            reading = super().read()
        shown = reading.q.copy()
        for axis, spec in enumerate(AXES):
            if onset := self._onsets.get(f"potentiometer.{spec.name}.stuck"):
                shown[axis] = onset.q[axis]
        return AxesReading(time=reading.time, q=shown, channels=reading.channels)

    def put(self, goal: Array) -> None:
        here, goal = super().read().q, goal.copy()
        for axis, spec in enumerate(AXES):
            if self._present(slow := f"motor.{spec.name}.slow"):
                pace = (self._faults[slow].value or 1.0) * spec.speed * CYCLE
                goal[axis] = np.clip(goal[axis], here[axis] - pace, here[axis] + pace)
            if onset := self._onsets.get(f"motor.{spec.name}.dead"):
                goal[axis] = onset.q[axis]
        super().put(goal)

    def _felt(self, time: float) -> dict[str, float]:
        felt = super()._felt(time)
        for name, fixed in _FIXED.items():
            if self._present(name):
                felt |= fixed
        if onset := self._onsets.get("range.frozen"):
            felt["range"] = onset.ranged
        return felt

    def state(self) -> ArmState:
        return with_fields(super().state(), onsets=tuple(self._onsets.values()))

    def check(self, state: ArmState) -> None:
        super().check(state)
        if any(each.fault not in self._faults or len(each.q) != len(AXES) for each in state.onsets):
            raise BadFile("the faults of the saved arm are not those of this arm")

    def restore(self, state: ArmState) -> None:
        self._onsets = {each.fault: each for each in state.onsets}
        super().restore(state)
