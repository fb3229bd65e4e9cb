"""Defines the water pump as a task, which connects scene, worlds, faults, programs and referee."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from handeye.arm.robots.stanford import STANFORD
from handeye.tasks.interface import CameraSetup, Disturbance, ExportedScene, HistoricalTiming, Task, Words
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.world.nominal import DRAWING, LOOKS
from handeye.tasks.water_pump.world.stations import planned_fixtures

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.rendering import RendererMaker
    from handeye.cell.simulated import SimulatedCell
    from handeye.cell.truth import Truth
    from handeye.core.faults import Catalogue
    from handeye.core.pose import Array
    from handeye.core.variation import Variation, WorldSpec
    from handeye.judge.finding import Findings
    from handeye.program.program import Fixture
    from handeye.proof.obligation import Obligation
    from handeye.tasks.trial import Trial


PINNED: Final = range(4, 9)  # numbers of the stages at whose end the aligning pins stand in the base


class WaterPump(Task):
    """Put gasket and top on the base of an automobile water pump, and screw them down."""

    name = "water_pump"
    arm = STANFORD
    park = PARK
    words = Words(product="the pump", done="The pump is assembled.", apart="The pump is taken apart.")
    script = "water_pump.al"
    other_scripts = ("water_pump_1973.al",)
    eye = CameraSetup(drawing=DRAWING, looks=LOOKS)
    photographs = ("studio", "pump")
    period = HistoricalTiming(
        year=1973,
        program="water_pump",
        times={"planning": 60.0, "manipulation": 240.0, "lens": 90.0, "vision": 2.0},
        differs="The job of 1973 had eleven steps. This program has twelve stages and more checks, so it does more "
        "work. The program water_pump_1973 has only the eleven stages that correspond to those steps.",
    )  # Bolles and Paul, STAN-CS-73-396
    contacts = MappingProxyType({
        "grasp": ("WEB",), "pin": ("T1", "T2"), "gasket": ("GON",), "top": ("TOPON",),
        "screw": ("H0", "H1", "H2", "H3", "H4", "H5"), "rotor": ("CRANK",),
    })  # fmt: skip
    holds_from = MappingProxyType({
        "base": 3, "gasket": 5, "top": 7, "screws_depth": 8, "screws_place": 8, "screws_crossed": 8, "pins": 9,
    })  # fmt: skip

    @property
    def trials(self) -> Mapping[str, Trial[Any]]:
        from handeye.tasks.water_pump.trials.base import BaseTrial
        from handeye.tasks.water_pump.trials.gasket import GasketTrial

        return {"base": BaseTrial(), "gasket": GasketTrial()}

    def fixtures(self) -> Mapping[str, Fixture]:
        return planned_fixtures()

    def variation(self) -> Variation:
        from handeye.tasks.water_pump.world.variation import variation

        return variation()

    def faults(self, world: WorldSpec) -> Catalogue:
        from handeye.tasks.water_pump.faults.catalogue import catalogue

        return catalogue(world)

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        from handeye.tasks.water_pump.scene import dressed
        from handeye.tasks.water_pump.world.pump_world import PumpWorld

        return dressed(PumpWorld.draw(spec))

    def cell(self, spec: WorldSpec, camera: str | RendererMaker) -> SimulatedCell:
        from handeye.tasks.water_pump.cell import build_cell
        from handeye.tasks.water_pump.world.pump_world import PumpWorld

        return build_cell(PumpWorld.draw(spec), camera=camera)

    def exported(self, world: WorldSpec, truth: Truth, keyframe: str) -> ExportedScene:
        from handeye.tasks.water_pump.exported import exported
        from handeye.tasks.water_pump.world.pump_world import PumpWorld

        return exported(PumpWorld.draw(world), truth, keyframe)

    def obligations(self, world: WorldSpec) -> tuple[Obligation, ...]:
        from handeye.tasks.water_pump.obligations.findings import obligations
        from handeye.tasks.water_pump.world.variation import screws

        return obligations(screws(world))

    def disturbances(self) -> tuple[Disturbance, ...]:
        from handeye.tasks.water_pump.faults.after import disturbances

        return disturbances()

    def bystanders(self, truth: Truth) -> Mapping[str, Array]:
        from handeye.tasks.water_pump.faults.after import bystanders

        return bystanders(truth)

    def judge(self, truth: Truth) -> Findings:
        from handeye.tasks.water_pump.referee.findings import judge

        return judge(truth)

    def judge_between(self, truth: Truth, done: int) -> Findings:
        from handeye.tasks.water_pump.referee.findings import judge_pins

        return judge_pins(truth) if done in PINNED else {}

    @property
    def referees(self) -> Mapping[str, Callable[[Truth], Findings]]:
        from handeye.tasks.water_pump.referee.over_web import judge_over_web

        return {"over_web": judge_over_web}

    def judge_apart(self, truth: Truth) -> Findings:
        from handeye.tasks.water_pump.referee.findings import judge_apart

        return judge_apart(truth)


WATER_PUMP: Final = WaterPump()
