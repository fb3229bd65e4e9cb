"""The relay as a system."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Final

import msgspec

from handeye.arm.model import digest as arm_digest
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.execution.state import ReversalOrder
from handeye.planfile.store import written_digest
from handeye.program.events import Choice
from handeye.program.numbered import encode
from handeye.runs.legs import leg_system
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.system import ExecutedStep, Listing, RunCallbacks, StepperWords, System
from handeye.systems.relay import ENTRY
from handeye.systems.relay.check import check_plan
from handeye.systems.relay.executed import executed
from handeye.systems.relay.plan import RelayPlan, decode, decoded, listing
from handeye.systems.relay.running import RunningRelay
from handeye.systems.relay.state import RelayCore, state_type
from handeye.tasks import task
from handeye.vision.calibration import Calibration


class RelaySystem(System):
    """Runs the programs of a relay."""

    name = ENTRY.name
    plan = RelayPlan
    words = StepperWords(
        about=(
            "A step of a relay is a step of the present leg's program. Each leg is a stage.",
            "Between two legs, the brakes are set, and a record is handed over.",
        ),
        units="those of each program",
    )

    @cached_property
    def state(self) -> type[RelayCore]:  # type: ignore[override]  # the type depends on the systems that are installed
        return state_type()

    def encode(self, plan: RelayPlan) -> bytes:
        return encode(plan)

    def decode(self, data: bytes, name: str) -> RelayPlan:
        return decode(data, name)

    def digest(self, plan: RelayPlan, data: bytes) -> str:
        """Return a digest of the relay's text and of the digests of its programs."""
        own = [leg_system(each.system).digest(decoded(each), each.plan.encode()) for each in plan.programs]
        return written_digest(msgspec.json.encode([plan.name, plan.text, plan.task, own]))

    def alike(self, one: RelayPlan, other: RelayPlan) -> bool:
        return (one.text, len(one.programs)) == (other.text, len(other.programs)) and all(
            (a.file, a.system) == (b.file, b.system) and leg_system(a.system).alike(decoded(a), decoded(b))
            for a, b in zip(one.programs, other.programs, strict=True)
        )

    def listing(self, plan: RelayPlan) -> Listing:
        return listing(plan)

    def build(self, setup: Setup, around: RunCallbacks) -> RunningRelay:
        self.check(setup)
        return RunningRelay(setup, around, self.state())

    def machine(self, plan: RelayPlan) -> tuple[str, str]:
        arm = task(plan.task).arm
        return arm.name, arm_digest(arm)

    def check(self, setup: Setup) -> None:
        super().check(setup)
        assert isinstance(setup.plan, RelayPlan)
        check_plan(setup.plan)
        work, world = task(setup.task), setup.world
        work.variation().check(world)
        work.faults(world).check(world.faults)
        stages = len(setup.plan.legs)
        if any((fault.stage or 0) > stages for fault in world.faults):
            raise BadArgument(
                f"a fault begins after the last stage of the relay, which has {counted(stages, 'stage')}"
            )

    def executed(self, plan: RelayPlan, state: RelayCore) -> Sequence[ExecutedStep]:
        return executed(plan, state)

    def order(self, plan: RelayPlan, state: RelayCore, undoing: ReversalOrder) -> None:
        raise BadArgument("the steps of a relay can be undone only in the stepper, while the relay runs")

    def calibration(self, state: RelayCore) -> Calibration | None:
        return None if state.station is None else state.station.calibration

    def choices(self, runner: Runner) -> Mapping[Choice, str]:
        return {
            "proceed": "proceed: continue after the step that called the operator",
            "retry": "retry: repeat the stage, in the world as it is now",
            "skip": "skip: leave out the rest of the stage",
        }


RELAY: Final = RelaySystem()
