"""Trials of jobs: a program works on boards drawn from seeds, and the results are judged."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import msgspec

from handeye.core.variation import WorldSpec
from handeye.results.finishing import finished
from handeye.results.result import Check
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.run.jobs import job_setup
from handeye.systems.sigma.run.plan import JobName, MalPlan
from handeye.trials.sweep import Case, Sweep, TrialRow

_OUTCOMES: Final = {0: "right", 1: "stopped", 3: "silent"}


class JobRow(TrialRow, frozen=True, kw_only=True):
    """The trial of one board."""

    pieces: int = 0
    result: str = ""  # right, silent, or stopped
    message: str = ""  # the reason why the program stopped
    checks: Mapping[str, Check] = {}
    figures: Mapping[str, float] = {}

    @property
    def outcome(self) -> str:
        return self.result

    @property
    def detail(self) -> str:
        wrong = [check.told for check in self.checks.values() if check.refuses]
        return "; ".join(filter(None, (super().detail, self.message, *wrong)))

    @property
    def measures(self) -> Mapping[str, float]:
        return {f"{name}, {check.unit}": check.value for name, check in self.checks.items()}

    @property
    def facts(self) -> Mapping[str, float]:
        return self.figures


@dataclass(frozen=True, slots=True, kw_only=True)
class JobWork:
    """Works on a board."""

    plan: MalPlan
    world: WorldSpec

    def __call__(self, case: Case) -> list[JobRow]:
        """Run one trial."""
        world = msgspec.structs.replace(self.world, seed=case.seed)
        runner = Runner(Checkpoint(setup=job_setup(self.plan, world)))
        result = finished(runner, advance(runner), Meter(), judged=True)
        return [
            JobRow(
                trial=case.trials[0],
                seed=case.seed,
                pieces=self.plan.pieces,
                result=_OUTCOMES[result.exit_code],
                message=result.message if not result.completed else "",
                checks=result.referee,
                figures=result.figures or {},
            )
        ]


def _more(rows: Sequence[JobRow]) -> dict[str, object]:
    """Return the means of the figures, and the greatest error of each kind."""
    ended = [row for row in rows if row.figures]
    names = ended[0].figures if ended else ()
    most: dict[str, float] = {}
    for row in rows:
        for name, value in row.measures.items():
            most[name] = max(most.get(name, 0.0), value)
    means = {name: round(sum(row.figures[name] for row in ended) / len(ended), 4) for name in names}
    return {"most": most, "means": means}


def _summary(rows: Sequence[JobRow]) -> list[str]:
    means = _more(rows)["means"]
    assert isinstance(means, dict)
    if not means:
        return []
    return [
        f"on average {means['commands']:.0f} commands and questions in {means['simulated_s']:.1f} s: "
        f"{means['commands_per_second']:.1f} a second, {means['bus_saturation']:.2%} of what the bus can carry; "
        f"the computer is idle for {means['computer_idle']:.0%} of the time"
    ]


def _sweep(job: JobName) -> Sweep[JobRow]:
    """Return the kind of sweep for the trials of a job."""
    return Sweep(
        kind=job,
        row=JobRow,
        outcomes={"right": "right", "silent": "silent", "stopped": "wrong"},
        success="right",
        more=_more,
        summary=_summary,
    )


CHESS_TRIALS: Final = _sweep("chess")
HANDOVER_TRIALS: Final = _sweep("handover")
INSERTION_TRIALS: Final = _sweep("insert")
PRCO_TRIALS: Final = _sweep("prco")
LINE_TRIALS: Final = _sweep("line")
