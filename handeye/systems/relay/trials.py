"""Trials of a relay: its legs work in worlds generated from seeds, and the referee judges the pumps."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

import numpy as np
from msgspec.structs import replace

from handeye.cell.arm_contact import ArmContact
from handeye.cell.simulated import SimulatedCell
from handeye.core.entries import entry_named
from handeye.core.record import Record
from handeye.execution.servo import ServoPeriod
from handeye.program.events import AnyEvent, StageFinished, StageStarted
from handeye.results.finishing import finished
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trials.jobs import OUTCOMES, JobRow
from handeye.trials.sweep import Case, Details, Sweep


class LegTrial(Record, frozen=True, kw_only=True):
    """A leg in one world."""

    stage: str
    system: str
    ended: str
    arm_s: float
    peak_n: float
    """At the end of each servo period, the simulator gives the resultant force (N) of all contacts on the arm. This
    field is the greatest of these forces. It includes the weight of a held part.
    """


class RelayRow(JobRow, frozen=True, kw_only=True):
    """A relay in one world."""

    legs: tuple[LegTrial, ...] = ()  # those that have begun

    @property
    def stage(self) -> str:
        return self.legs[-1].stage if self.legs and self.result == "stopped" else ""

    @property
    def facts(self) -> Mapping[str, float]:
        return {f"{leg.stage}, s": leg.arm_s for leg in self.legs}


class LegPeaks(Observer):
    """Records the greatest force on the arm in each stage (N)."""

    def __init__(self, cell: SimulatedCell) -> None:
        self.most: dict[str, float] = {}
        self._contact, self._stage = ArmContact(cell), ""

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StageStarted):
            self._stage = event.stage
        elif isinstance(event, StageFinished):
            self._stage = ""

    def tick(self, period: ServoPeriod) -> None:
        if self._stage:
            here = float(np.linalg.norm(self._contact.force()))
            self.most[self._stage] = max(self.most.get(self._stage, 0.0), here)


class RelayWork:
    """Runs a relay in a world."""

    def __init__(self, setup: Setup) -> None:
        """`setup` is the setup of the run in the first world."""
        self.setup = setup

    def __call__(self, case: Case) -> list[RelayRow]:
        """Run one trial."""
        setup = replace(self.setup, world=replace(self.setup.world, seed=case.seed))
        peaks: list[LegPeaks] = []

        def observers(runner: Runner) -> Sequence[Observer]:
            peaks.append(LegPeaks(runner.arm_cell))
            return peaks

        runner = Runner(Checkpoint(setup=setup), observers=observers)
        result = finished(runner, advance(runner), Meter(), judged=True)
        times = {stage.name: stage for stage in result.stages}
        return [
            RelayRow(
                trial=case.trials[0],
                seed=case.seed,
                result=OUTCOMES[result.exit_code],
                message=result.message if not result.completed else "",
                checks=result.referee,
                legs=tuple(
                    LegTrial(
                        stage=stage,
                        system=system,
                        ended=times[stage].status,
                        arm_s=times[stage].arm_s,
                        peak_n=round(peaks[0].most.get(stage, 0.0), 3),
                    )
                    for system, stage in runner.system.legs
                    if times[stage].status != "not reached"
                ),
            )
        ]


class LegLine(Record, frozen=True, kw_only=True):
    """A leg over all worlds."""

    stage: str
    system: str
    reached: int
    ended: int  # number of legs that ended as they should
    mean_s: float | None  # of the legs that ended as they should
    median_n: float | None
    most_n: float | None


def _lines(rows: Sequence[RelayRow]) -> Iterator[LegLine]:
    for stage, system in dict.fromkeys((leg.stage, leg.system) for row in rows for leg in row.legs):
        begun = [(row, leg) for row in rows for leg in row.legs if leg.stage == stage]
        done = [leg for row, leg in begun if row.stage != stage]
        yield LegLine(
            stage=stage,
            system=entry_named(system).title,
            reached=len(begun),
            ended=len(done),
            mean_s=round(float(np.mean([leg.arm_s for leg in done])), 2) if done else None,
            median_n=round(float(np.median([leg.peak_n for leg in done])), 2) if done else None,
            most_n=round(max(leg.peak_n for leg in done), 2) if done else None,
        )


def _details(rows: Sequence[RelayRow]) -> tuple[Details, ...]:
    heads = ("leg", "language", "reached", "ended well", "mean", "median peak, N", "greatest peak, N")
    return (Details(name="legs", title="Legs", rows=[*_lines(rows)], heads=heads),)


RELAYS: Final = Sweep(
    kind="relay",
    row=RelayRow,
    outcomes={"right": "right", "silent": "silent", "stopped": "wrong"},
    success="right",
    narrated=True,
    details=_details,
    summary=lambda _: [
        "At the end of each servo period, the simulator gives the resultant force of all contacts on the arm. A "
        "peak is the greatest of these forces. It includes the weight of a held part."
    ],
)
