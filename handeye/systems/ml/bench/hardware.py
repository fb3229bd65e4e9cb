"""The hardware of a run whose arm is simulated at a station, and the task of a program that moves the arm over an
empty table.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Final, Literal

from handeye.core.units import MILLIMETRES
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Findings
from handeye.systems.ml.bench.arm import AXES
from handeye.systems.ml.bench.left_arm import add_left_arm
from handeye.systems.ml.bench.station import CAMERA, Station, scene
from handeye.systems.ml.bench.world import ALONE, ArmWorld
from handeye.systems.ml.run.hardware import Hardware, StationTask, Tell
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.snapshot_cell import SnapshotCell
    from handeye.cell.truth import Truth
    from handeye.execution.servo import ServoPeriod
    from handeye.systems.ml.run.plan import MlPlan


class StationHardware(Hardware):
    """The arm of a station."""

    watched = 2

    def __init__(self, station: Station, tell: Tell) -> None:
        self.station, self._arm = station, station.arm
        self.machine = station.machine(tell)
        self.joints, self.channels = [*self._arm.joints], self._arm.traced

    @cached_property
    def cell(self) -> SnapshotCell:
        return self.station.cell()

    @property
    def servo_period(self) -> ServoPeriod:
        return self._arm.servo_period

    def signal(self, interlock: str, *, on: bool) -> None:
        self.station.signal(interlock, on=on)


class ArmTask(StationTask):
    """The arm over an empty table. It has no referee."""

    name = "rectilinear"
    words = Words(product="the program", done="The program has ended.")
    camera = CAMERA
    force_axes = "the axes of the hand"
    measures = MILLIMETRES
    joint_kinds: Mapping[str, Literal["revolute", "prismatic"]] = {spec.name: spec.kind for spec in AXES[:-2]}

    def variation(self) -> Variation:
        return ALONE

    def world(self, spec: WorldSpec) -> ArmWorld:
        """Return the world that a specification describes."""
        return ArmWorld(spec, self.variation())

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return scene(self.world(spec)).compile()

    def recorded_scene(self, spec: WorldSpec, plan: bytes) -> mujoco.MjModel:
        from handeye.systems.ml.run.plan import decode

        two = decode(plan, "the plan of the run").left is not None
        return self._alone(self.world(spec), two=two).compile() if two else self.scene(spec)

    def hardware(self, plan: MlPlan, world: WorldSpec, tell: Tell) -> Hardware:
        errors, two = self.world(world), plan.left is not None
        return StationHardware(Station(self._alone(errors, two=two), errors, left=two), tell)

    def _alone(self, world: ArmWorld, *, two: bool) -> mujoco.MjSpec:
        """Return the scene of the arm over an empty table. If `two` is True, the scene also has the left arm."""
        spec = scene(world)
        if two:
            add_left_arm(spec)
        return spec

    def judge(self, truth: Truth) -> Findings:
        return {}


RECTILINEAR: Final = ArmTask()
