"""Defines the job `support` and its worlds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from handeye.cell.physics_stepper import allow
from handeye.cell.threads import ThreadFigures, Threads
from handeye.core.faults import Catalogue
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Findings
from handeye.systems.ml.bench.faults import put_away
from handeye.systems.ml.bench.hardware import ArmTask
from handeye.systems.ml.bench.reporting import Listener, ReportingHardware, counted
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.machine.spec import CYCLES_PER_SECOND
from handeye.systems.ml.run.hardware import Hardware, Tell
from handeye.systems.ml.support.drawing import VARIATION, Drawing
from handeye.systems.ml.support.equipment import ForceGauge, PowerScrewdriver, ScrewdriverCurrent
from handeye.systems.ml.support.faults import FAULTS, MAY_LACK, TROUBLES
from handeye.systems.ml.support.happenings import FOUND, reported
from handeye.systems.ml.support.referee import judge
from handeye.systems.ml.support.scene import add_support
from handeye.tasks.interface import Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.mechanism import Mechanism
    from handeye.cell.truth import Truth
    from handeye.systems.ml.run.plan import MlPlan


class SupportHardware(ReportingHardware):
    """The station with the parts of the rail support."""

    def __init__(
        self, station: Station, gauge: ForceGauge, tell: Tell, troubles: Mapping[str, str] = TROUBLES
    ) -> None:
        super().__init__(station, tell, troubles)
        self._gauge, self._tell = gauge, tell

    def hear(self, text: str) -> None:
        super().hear(text)
        if (screw := reported(text, self.machine.now / CYCLES_PER_SECOND)) is not None:
            self._tell(screw)

    @property
    def figures(self) -> Mapping[str, float]:
        forces = self._gauge.greatest
        found = Counter(screw.found for line in self.heard if (screw := reported(line, 0.0)) is not None)
        return {
            **{f"screws_{name.replace(' ', '_')}": found[name] for name in FOUND.values()},
            "fingers_driving_N": round(forces.driving, 1),
            "fingers_along_N": round(forces.along, 1),
            "fingers_across_N": round(forces.across, 1),
        }


class Support(ArmTask):
    """Assemble a rail support of 22 parts, with ten screws."""

    name = "support"
    words = Words(product="the rail support", done="The rail support is assembled from its 22 parts.")

    def variation(self) -> Variation:
        return VARIATION

    def faults(self, world: WorldSpec) -> Catalogue:
        return FAULTS

    def station(self, world: ArmWorld) -> tuple[Station, ForceGauge]:
        """Return the station with its parts."""
        spec = scene(world, wand=False)
        add_support(spec, Drawing(world))
        for part in MAY_LACK:
            if world.fault(f"{part}.missing") is not None:
                put_away(spec, part)
        return screwing(spec, world)

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return self.station(self.world(spec))[0].bench.model

    def hardware(self, plan: MlPlan, world: WorldSpec, tell: Tell) -> Hardware:
        return SupportHardware(*self.station(self.world(world)), tell)

    def judge(self, truth: Truth) -> Findings:
        """Judge the assembled support, and the last count of parts that the program printed."""
        return judge(truth, counted(truth.states[Listener.name]))


def screwing(
    spec: mujoco.MjSpec, world: ArmWorld, others: Sequence[Mechanism[Any]] = ()
) -> tuple[Station, ForceGauge]:
    """Return the station of a scene that has the parts of the support. Also return the station's force gauge. In this
    station, the screwdriver can drive the screws.

    Args:
        others: other mechanisms of the job. The cell keeps the states of these mechanisms, but the mechanisms do
            nothing as time passes.
    """
    drawing, driver = Drawing(world), PowerScrewdriver()
    tools = {"screwdriver": driver.turn, "reverse": driver.reverse}
    station = Station(spec, world, tools=tools, others=others)
    bench = station.bench
    for name in ("frame", "driver"):
        allow(bench.model, int(bench.model.body_treeid[bench.model.body(name).id]))
    station.arm.torque = ScrewdriverCurrent(
        bench.model, bench.data, world.numbers("torque"), drawing.torque_noise
    )
    figures = ThreadFigures(phases=drawing.phases, friction=drawing.friction)
    bench.add(Threads(bench.model, bench.data, driver, figures))
    bench.add(gauge := ForceGauge(bench.model, bench.data, driver))
    return station, gauge


SUPPORT: Final = Support()
