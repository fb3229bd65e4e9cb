"""Trials of jobs: a program works in worlds drawn from seeds, and the results are judged."""

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
from handeye.systems.ml.run.jobs import job_setup
from handeye.systems.ml.run.plan import MlPlan
from handeye.trials.sweep import Case, Sweep, TrialRow

_OUTCOMES: Final = {0: "right", 1: "stopped", 3: "silent"}


class MlJobRow(TrialRow, frozen=True, kw_only=True):
    """The trial of one world."""

    variant: str = ""
    result: str = ""  # right, silent, or stopped
    message: str = ""  # the reason why the run stopped
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
class MlJobWork:
    """Does a job in a world."""

    plan: MlPlan
    world: WorldSpec

    def __call__(self, case: Case) -> list[MlJobRow]:
        """Run one trial."""
        world = msgspec.structs.replace(self.world, seed=case.seed)
        runner = Runner(Checkpoint(setup=job_setup(self.plan, world)))
        result = finished(runner, advance(runner), Meter(), judged=True)
        return [
            MlJobRow(
                trial=case.trials[0],
                seed=case.seed,
                variant=self.plan.variant,
                result=_OUTCOMES[result.exit_code],
                message=result.message if not result.completed else "",
                checks=result.referee,
                figures=result.figures or {},
            )
        ]


def _more(rows: Sequence[MlJobRow]) -> dict[str, object]:
    """Return the means of the figures, and the greatest error of each kind."""
    ended = [row for row in rows if row.figures]
    names = ended[0].figures if ended else ()
    most: dict[str, float] = {}
    for row in rows:
        for name, value in row.measures.items():
            most[name] = max(most.get(name, 0.0), value)
    means = {name: round(sum(row.figures[name] for row in ended) / len(ended), 4) for name in names}
    return {"most": most, "means": means}


def _summary(rows: Sequence[MlJobRow]) -> list[str]:
    means = _more(rows)["means"]
    assert isinstance(means, dict)
    if not means:
        return []
    return [
        f"on average {means['statements']:.0f} statements and {means['motions']:.0f} motions in "
        f"{means['simulated_s']:.1f} s, with {means['force_events']:.0f} force events"
    ]


def _sweep(job: str) -> Sweep[MlJobRow]:
    """Return the kind of sweep for the trials of a job."""
    return Sweep(
        kind=job,
        row=MlJobRow,
        outcomes={"right": "right", "silent": "silent", "stopped": "wrong"},
        success="right",
        more=_more,
        summary=_summary,
    )


FOLLOW_TRIALS: Final = _sweep("follow")
BLOCKS_TRIALS: Final = _sweep("blocks")
TRAIN_TRIALS: Final = _sweep("train")
