"""Trials of jobs: a program works in worlds drawn from seeds, and the results are judged."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Generic, TypeVar

import msgspec

from handeye.results.finishing import finished
from handeye.results.result import Check
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trials.sweep import Case, Sweep, TrialRow

OUTCOMES: Final = {0: "right", 1: "stopped", 3: "silent"}


class JobRow(TrialRow, frozen=True, kw_only=True):
    """The trial of one world."""

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


J = TypeVar("J", bound=JobRow)


@dataclass(frozen=True, slots=True, kw_only=True)
class JobWork(Generic[J]):
    """Does a job in a world."""

    setup: Setup  # of the first world
    row: Callable[..., J]
    settings: Mapping[str, object]  # settings that are recorded in each row

    def __call__(self, case: Case) -> list[J]:
        """Run one trial."""
        world = msgspec.structs.replace(self.setup.world, seed=case.seed)
        runner = Runner(Checkpoint(setup=msgspec.structs.replace(self.setup, world=world)))
        result = finished(runner, advance(runner), Meter(), judged=True)
        return [
            self.row(
                trial=case.trials[0],
                seed=case.seed,
                result=OUTCOMES[result.exit_code],
                message=result.message if not result.completed else "",
                checks=result.referee,
                figures=result.figures or {},
                **self.settings,
            )
        ]


def job_sweep(job: str, row: type[J], sentence: Callable[[Mapping[str, float]], str]) -> Sweep[J]:
    """Return the kind of sweep for the trials of a job. `sentence` takes the mean values of the job's figures and
    returns a sentence about them.
    """
    return Sweep(
        kind=job,
        row=row,
        outcomes={"right": "right", "silent": "silent", "stopped": "wrong"},
        success="right",
        more=lambda rows: {"most": _most(rows), "means": _means(rows)},
        summary=lambda rows: [sentence(means)] if (means := _means(rows)) else [],
    )


def _most(rows: Sequence[JobRow]) -> dict[str, float]:
    """Return the greatest value of each measured error."""
    most: dict[str, float] = {}
    for row in rows:
        for name, value in row.measures.items():
            most[name] = max(most.get(name, 0.0), value)
    return most


def _means(rows: Sequence[JobRow]) -> dict[str, float]:
    """Return the mean value of each figure."""
    ended = [row.figures for row in rows if row.figures]
    if not ended:
        return {}
    return {name: round(sum(each[name] for each in ended) / len(ended), 4) for name in ended[0]}
