"""A whole run of the pump's program in a world from a seed, and the values that the reference's rows require of every
run.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.program.events import (
    AnyEvent,
    CameraBusy,
    GuardTripped,
    StageFinished,
    StageStarted,
    StepStarted,
)
from handeye.results.result import Result
from handeye.runs.folder import RESULT, open_again
from handeye.runs.runner import Runner
from handeye.trials.assembly import run_plan

STAGES = (
    "find the base", "feel for the grasp", "put the base in its standard position", "insert the aligning pins",
    "put on the gasket", "check the gasket", "put on the top", "drive the first two screws",
    "take out the aligning pins", "drive the last four screws", "turn the rotor", "inspect the pump",
)  # fmt: skip
"""The eleven steps of 1973, and a last one that inspects their work."""


@dataclass(frozen=True, kw_only=True)
class Whole:
    """A run that has ended, its result, and all its events."""

    result: Result
    runner: Runner
    """The runner in its final state."""

    @property
    def events(self) -> Sequence[AnyEvent]:
        return self.runner.events

    def during(self, stage: str) -> list[AnyEvent]:
        """Events of a stage."""
        names = [e.stage if isinstance(e, StageStarted) else None for e in self.events]
        start = names.index(stage)
        ends = [i for i, e in enumerate(self.events) if isinstance(e, StageFinished) and i > start]
        return list(self.events[start : ends[0]])

    def started(self) -> tuple[str, ...]:
        """Stages that began, in order."""
        return tuple(e.stage for e in self.events if isinstance(e, StageStarted))

    def done(self) -> tuple[str, ...]:
        """Stages that were done, in order."""
        return tuple(e.stage for e in self.events if isinstance(e, StageFinished) and e.status == "done")

    def torques(self, stage: str) -> int:
        """Motions of a stage that ended by torque."""
        return sum(isinstance(e, GuardTripped) and e.guard == "torque" for e in self.during(stage))

    def searched(self) -> set[str]:
        """Places of the holes that needed more than one more try: H0 to H5 are those of screws, T1 and T2 of pins."""
        texts = [event.text for event in self.events if isinstance(event, StepStarted)]
        again: list[str] = []
        place = ""
        for word, *names in map(str.split, texts):
            place = names[0] if word == "MOVE" else place
            again += [place] if word == "AOJ" and place[0] in "HT" else []
        return {place for place in again if again.count(place) > 1}

    def lens(self) -> float:
        """Time that lenses, aiming and focusing took, s."""
        return sum(event.seconds for event in self.events if isinstance(event, CameraBusy))


def whole_run(plan: Plan, world: WorldSpec) -> Whole:
    """Execute the plan in a world."""
    finished = run_plan(plan, world=world)
    return Whole(result=finished.result, runner=finished.runner)


def whole_in(folder: Path) -> Whole:
    """Read a run from its folder, in its final state."""
    _, end, faults = open_again(folder)
    assert faults == []
    result = msgspec.json.decode((folder / RESULT).read_bytes(), type=Result)
    return Whole(result=result, runner=Runner(end))
