"""Trials of stages: in each world, the careful program builds the pump up to a stage. Then a program in each language
does this stage, from the same state, and the referee judges the pump as it is after this stage.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import Final

import numpy as np
from msgspec import field
from msgspec.structs import replace

from handeye.core.errors import Refused
from handeye.core.record import Record
from handeye.results.finishing import finished
from handeye.results.judging import findings_after
from handeye.results.result import Check
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.relay.stages.exchange import exchanged
from handeye.systems.relay.stages.languages import (
    WITHOUT_LEG,
    StageLeg,
    TimedProgram,
    limits,
    relay_of,
    stages,
)
from handeye.systems.relay.trials import LegPeaks
from handeye.trials.comparing import PairedTrial, beside
from handeye.trials.figures import rate
from handeye.trials.sound_run import sound_run
from handeye.trials.sweep import Case, Details, Sweep, TrialRow

NOT_REACHED: Final = "not reached"


class StageRow(TrialRow, frozen=True, kw_only=True):
    """The trial of a stage in one language and one world."""

    of: str = ""  # the stage
    language: str = ""
    result: str = (
        "stopped"  # accepted, silent, stopped, or not reached: the careful program had stopped before
    )
    message: str = ""  # the call to the operator
    checks: dict[str, Check] = field(default_factory=dict)  # findings that must hold after the stage
    arm_s: float = 0.0
    peak_n: float = 0.0
    """At the end of each servo period, the simulator gives the resultant force (N) of all contacts on the arm. This
    field is the greatest of these forces. It includes the weight of a held part.
    """
    lines: int = 0
    plan_cpu_s: float = 0.0  # CPU time that this computer needed to plan, teach or read the program

    @property
    def outcome(self) -> str:
        return self.result

    @property
    def stage(self) -> str:
        return "referee" if self.result == "silent" else self.of if self.result == "stopped" else ""

    @property
    def detail(self) -> str:
        wrong = "; ".join(check.told for check in self.checks.values() if check.refuses)
        return super().detail or self.message or wrong

    @property
    def measures(self) -> Mapping[str, float]:
        return {"arm, s": self.arm_s, "peak, N": self.peak_n} if self.result == "accepted" else {}


@dataclass(frozen=True, slots=True, kw_only=True)
class StageWork:
    """Runs the stage of a case in the language of the case."""

    careful: Setup  # of the careful program, as a relay, in the first world
    folder: Path  # that has the runs of the careful program
    legs: Mapping[str, StageLeg]  # by condition
    programs: Mapping[str, TimedProgram]  # by file

    def __call__(self, case: Case) -> list[StageRow]:
        """Run one trial."""
        leg, world = self.legs[case.condition], replace(self.careful.world, seed=case.seed)
        done = stages().index(leg.stage) + 1
        row = StageRow(
            trial=case.trials[0],
            seed=case.seed,
            condition=case.condition,
            of=leg.stage,
            language=leg.language,
            result=NOT_REACHED,
            lines=leg.lines,
            plan_cpu_s=self.programs[leg.file].cpu_s,
        )
        try:
            start = sound_run(self.folder, self.careful, world, None).before(done)
        except Refused:
            return [row]
        relay = relay_of(leg, self.programs)
        return [replace(row, **stage_figures(exchanged(start, relay), leg.stage, done))]


def stage_figures(start: Checkpoint, stage: str, done: int) -> dict[str, object]:
    """Run the last leg of a relay from a checkpoint, and return the fields of the trial's row. `done` is the number of
    stages that are complete when this leg has ended.
    """
    peaks: list[LegPeaks] = []

    def observers(runner: Runner) -> Sequence[Observer]:
        peaks.append(LegPeaks(runner.arm_cell))
        return peaks

    runner = Runner(start, observers=observers)
    result = finished(runner, advance(runner), Meter(), judged=False)
    found = findings_after(runner, done)
    wrong = any(finding.refuses for finding in found.values())
    return {
        "result": "stopped" if not result.completed else "silent" if wrong else "accepted",
        "message": "" if result.completed else result.message,
        "checks": {name: Check.of(finding) for name, finding in found.items()},
        "arm_s": next(each.arm_s for each in result.stages if each.name == stage),
        "peak_n": round(peaks[0].most.get(stage, 0.0), 3),
    }


class CellLine(Record, frozen=True, kw_only=True):
    """How often a stage was accepted in one language."""

    stage: str
    language: str
    accepted: int
    n: int
    low_share: float | None  # Wilson's interval, 95 %
    high_share: float | None
    silent: int
    stopped: int


class CostLine(Record, frozen=True, kw_only=True):
    """What a stage costs in one language, computed from the accepted trials."""

    stage: str
    language: str
    median_s: float | None
    median_n: float | None
    most_n: float | None
    lines: int
    plan_s: float  # of this computer


class PairLine(Record, frozen=True, kw_only=True):
    """A comparison of two languages that do the same stage, in the worlds in which both were tried."""

    stage: str
    one: str
    other: str
    pairs: int
    only_one: int  # worlds in which only this language was accepted
    only_other: int
    p: float
    other_takes_s: (
        float | None
    )  # median difference of the arm's time, over the worlds in which both were accepted
    p_time: float | None


def _tried(rows: Sequence[StageRow]) -> Iterator[list[StageRow]]:
    """Yield the rows of each stage and language. Leave out the worlds in which the careful program stopped before the
    stage.
    """
    for condition in dict.fromkeys(row.condition for row in rows):
        mine = [row for row in rows if row.condition == condition and row.result != NOT_REACHED]
        if mine:
            yield mine


def _cells(rows: Sequence[StageRow]) -> Iterator[CellLine]:
    for mine in _tried(rows):
        counts = Counter(STAGES.standing(row) for row in mine)
        low, high = rate(counts["right"], len(mine)).wilson95 or (None, None)
        yield CellLine(
            stage=mine[0].of,
            language=mine[0].language,
            accepted=counts["right"],
            n=len(mine),
            low_share=low,
            high_share=high,
            silent=counts["silent"],
            stopped=counts["wrong"],
        )


def _costs(rows: Sequence[StageRow]) -> Iterator[CostLine]:
    for mine in _tried(rows):
        good = [row for row in mine if STAGES.standing(row) == "right"]
        yield CostLine(
            stage=mine[0].of,
            language=mine[0].language,
            median_s=_median([row.arm_s for row in good]),
            median_n=_median([row.peak_n for row in good]),
            most_n=max((row.peak_n for row in good), default=None),
            lines=mine[0].lines,
            plan_s=mine[0].plan_cpu_s,
        )


def _median(values: Sequence[float]) -> float | None:
    return round(float(np.median(values)), 2) if values else None


def _tests(rows: Sequence[StageRow]) -> Iterator[PairLine]:
    for stage in dict.fromkeys(row.of for row in rows):
        tried = {
            language: {
                ("", row.seed, 0): PairedTrial(STAGES.standing(row), row.broken_off, row.measures)
                for row in rows
                if (row.of, row.language) == (stage, language) and row.result != NOT_REACHED
            }
            for language in dict.fromkeys(row.language for row in rows if row.of == stage)
        }
        for one, other in combinations((name for name, trials in tried.items() if trials), 2):
            if not tried[one].keys() & tried[other].keys():
                continue
            pair = beside(other, tried[one], tried[other])
            time = pair.measures.get("arm, s")
            yield PairLine(
                stage=stage,
                one=one,
                other=other,
                pairs=pair.pairs,
                only_one=pair.only_first,
                only_other=pair.only_this,
                p=pair.p,
                other_takes_s=None if time is None else round(time.more, 2),
                p_time=None if time is None else time.p,
            )


def _details(rows: Sequence[StageRow]) -> tuple[Details, ...]:
    return (
        Details(
            name="cells", title="Stages by language", rows=[*_cells(rows)],
            heads=("stage", "language", "accepted", "of", "low", "high", "silent", "stopped"),
        ),
        Details(
            name="costs", title="Time, force and lines", rows=[*_costs(rows)],
            heads=("stage", "language", "arm, median", "peak, N", "greatest, N", "lines", "to plan"),
        ),
        Details(
            name="pairs", title="Pairs of languages in the same worlds", rows=[*_tests(rows)],
            heads=("stage", "one", "other", "pairs", "only one", "only other", "p", "other longer by", "p of time"),
        ),
        Details(
            name="limits", title=(
                "For each stage: its legs, and how many lines of the careful program TRIG, ML and MAL cannot express"
            ),
            rows=limits(),
            heads=("stage", "legs in", "TRIG, ML and MAL lack words for", "lines", "TRIG", "ML", "MAL"),
        ),
    )  # fmt: skip


def _summary(rows: Sequence[StageRow]) -> list[str]:
    stages_here = {row.of for row in rows}
    return [
        "Low and high: Wilson's interval, 95 %. The arm's time and the peaks are those of accepted trials. A peak "
        "is the greatest resultant force of all contacts on the arm at the end of a servo period; it includes the "
        "weight of a held part. To plan: CPU time of this computer to plan, teach or read the whole program. p: "
        "McNemar's exact test; p of time: Wilcoxon's signed-rank test, over the worlds in which the stage was "
        "accepted in both languages.",
        *(
            f"no leg: {stage}, {language}: {why}"
            for (stage, language), why in WITHOUT_LEG.items()
            if stage in stages_here
        ),
    ]


STAGES: Final = Sweep(
    kind="stages",
    row=StageRow,
    outcomes={"accepted": "right", "silent": "silent", "stopped": "wrong", NOT_REACHED: "uncounted"},
    success="accepted",
    narrated=True,
    details=_details,
    summary=_summary,
)
