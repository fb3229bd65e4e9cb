"""The faults that DIAGNOSE searches for, planted in the simulated gantries and on their bus."""

from collections.abc import Sequence
from functools import cache
from typing import Final

import mujoco
import numpy as np

from handeye.core.errors import BadArgument
from handeye.core.faults import Catalogue, FaultKind
from handeye.core.pose import Array
from handeye.core.variation import WorldSpec
from handeye.systems.sigma.bus.faults import check_place
from handeye.systems.sigma.bus.layout import SUPERSIGMA
from handeye.systems.sigma.diagnosis.bench import CUT, DIM, HALF, MANY, SAG
from handeye.systems.sigma.diagnosis.faults import FAULTS, OFFSET_N, MachineFault, Planted, variants
from handeye.systems.sigma.firmware.force import CONVERTER_N
from handeye.systems.sigma.firmware.motor import Motor
from handeye.systems.sigma.gantries.machine import ENDS, OPEN, Field, Gantries, Rig, Table
from handeye.systems.sigma.gantries.machine import SUPERSIGMA as SUPERSIGMA_RIG
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.protocol import COMPONENTS, NUMBERS

_SLOW_MS: Final = 400.0  # ms in which slow fingers close or open


@cache
def every_fault() -> dict[str, Planted]:
    """Return all faults that the machine of a job can have. The keys are the names of the faults. The usual variant of
    each fault comes first.
    """
    return {name: found for kind in FAULTS for name, found in variants(kind) if _possible(found)}


def _possible(planted: Planted) -> bool:
    numbers = [place.number for place in SUPERSIGMA.places]
    try:
        for defect in planted.bus:
            check_place(defect, len(SUPERSIGMA.behind), numbers)
    except BadArgument:
        return False
    return True


@cache
def catalogue() -> Catalogue:
    """Return the faults that a job can have. Trials of faults use one fault of each kind."""
    kinds = [
        FaultKind(name=name, meaning=f"{planted.told[0].upper()}{planted.told[1:]}.", when="before")
        for name, planted in every_fault().items()
    ]
    first = {kind.name.partition(".")[0]: kind.name for kind in reversed(kinds)}
    return Catalogue(*kinds, matrix=[kind.name for kind in kinds if kind.name in first.values()])


def planted_in(world: WorldSpec) -> tuple[Planted, ...]:
    """Return the faults of a world."""
    return tuple(every_fault()[fault.name] for fault in world.faults)


def gantries_of(
    spec: mujoco.MjSpec, world: GantryWorld, planted: Sequence[Planted], rig: Rig = SUPERSIGMA_RIG
) -> Gantries:
    """Return the gantries with these faults."""
    faults = [fault for each in planted for fault in each.machine]
    return FaultyGantries(spec, world, faults, rig) if faults else Gantries(spec, world, rig=rig)


class FaultyGantries(Gantries):
    """Gantries with faults."""

    def __init__(
        self,
        spec: mujoco.MjSpec,
        world: GantryWorld,
        faults: Sequence[MachineFault],
        rig: Rig = SUPERSIGMA_RIG,
    ) -> None:
        self._faults = {(fault.kind, fault.number): fault for fault in faults}
        self._every = [0] * len(rig.axes)  # every n-th pulse is left out; 0: none is
        self._stuck: dict[int, float] = {}  # limit of a switch that is stuck, by its row
        self._bits = [*self._of("converter")]
        self._sags = any(fault.kind == "supply" for fault in faults)
        super().__init__(spec, world, rig=rig)
        for fault in self._of("pulses"):
            self._every[self._axis[fault.number]] = fault.which
        for fault in self._of("phase"):
            self._pull[self._axis[fault.number]] *= HALF
        for fault in self._of("switch"):
            pin = "high" if fault.which else "low"
            row = next(row for row, each in ENDS.items() if each == pin) * self._n + self._axis[fault.number]
            self._stuck[row] = -np.inf if fault.level else np.inf
        for fault in self._of("accelerometer"):
            self._quiet(self._wrist[fault.number].start + fault.which)
        for fault in self._of("gauge"):
            self._strain_gauge(self._wrist[fault.number].start + fault.which, offset=bool(fault.level))
        for fault in self._of("multiplexer"):
            wrist = self._wrist[fault.number].start
            for rows in (self._felt, self._still):
                for first in (wrist, self._n + wrist):
                    rows[first : first + len(COMPONENTS)] = rows[first + fault.which]
        self._plan()

    def _of(self, kind: str) -> list[MachineFault]:
        return [fault for (each, _), fault in self._faults.items() if each == kind]

    def _quiet(self, axis: int) -> None:
        """Make the accelerometer of an axis give no signal."""
        for row in (axis, self._n + axis):
            self._felt[row, self._inertial] = self._still[row] = 0.0

    def _strain_gauge(self, axis: int, *, offset: bool) -> None:
        """Make the gauge of an axis read too much if `offset` is True, or nothing if `offset` is False."""
        for sense, row in ((1, axis), (-1, self._n + axis)):
            if offset:
                self._still[row] += sense * OFFSET_N
            else:
                self._felt[row], self._still[row] = 0.0, 0.0

    # -- sensors ---------------------------------------------------------------------------------------------

    def _sense(self) -> Array:
        sensed = super()._sense()
        for fault in self._bits:
            first, bit = self._wrist[fault.number].start, 1 << fault.which
            part = slice(first, first + len(COMPONENTS))
            raw = np.rint(sensed[part] / CONVERTER_N).astype(np.int64)
            sensed[part] = (raw | bit if fault.level else raw & ~bit) * CONVERTER_N
            sensed[self._n + part.start : self._n + part.stop] = -sensed[part]
        return sensed

    def beam(self, number: int) -> bool:
        if (stuck := self._faults.get(("beam", number))) is not None:
            return bool(stuck.level)
        passes = 0.0 if super().beam(number) else 1.0
        return passes * (DIM if ("lamp", number) in self._faults else 1.0) < CUT

    def _plan(self) -> None:
        super()._plan()
        for row, limit in self._stuck.items():
            self._limits[:, row] = limit

    # -- drives ----------------------------------------------------------------------------------------------

    def _pulls(self, speeds: Table) -> Table:
        pulls = super()._pulls(speeds)
        if self._sags:
            pulls[(speeds != 0).sum(axis=1) >= MANY] *= SAG
        return pulls

    def _field(self, index: int, motor: Motor) -> Field:
        every, missed = self._every[index], self.memory.missed
        if not every:
            return super()._field(index, motor)
        train = self._trains[index]
        if isinstance(train, tuple) and train and train[0] is not None:
            made = motor.memory.pulses - train[2]
            missed[index] += int(np.sign(made)) * (abs(made) // every)
        field = super()._field(index, motor)
        made_at = field.places - motor.memory.pulses
        lost = np.sign(made_at) * (np.abs(made_at) // every)
        return field._replace(places=field.places - lost - missed[index])

    def _draw(self) -> None:
        super()._draw()
        for hand, number in enumerate((NUMBERS["HAND1"], NUMBERS["HAND2"])):
            if ("fingers", number) in self._faults:
                self._move_slowly(hand)

    def _move_slowly(self, hand: int) -> None:
        gaps = self.memory.gaps
        goal = 0.0 if self.memory.grips[hand] else 1.0
        gaps[hand] += min(max(goal - gaps[hand], -1 / _SLOW_MS), 1 / _SLOW_MS)
        self.bench.data.ctrl[self._n + hand] = gaps[hand] * OPEN
