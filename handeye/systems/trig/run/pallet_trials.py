"""Palletising trials: in many worlds, a job is taught, executed, reversed and judged. The job is executed either
completely or until an interruption.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import msgspec

from handeye.core.distributions import random_numbers
from handeye.core.errors import PhysicsFailed, Refused
from handeye.core.variation import WorldSpec
from handeye.runs.runner import Runner
from handeye.systems.trig.run.job import JobReport, carried_out, setup_of_job
from handeye.trials.sweep import Case, Sweep, TrialRow

STEPS: Final = 14  # least number of steps per block, without loop ends
PLACES: Final = 15


class PalletRow(TrialRow, frozen=True, kw_only=True):
    """The row of one palletising trial."""

    report: JobReport | None = None  # None: interrupted

    @property
    def outcome(self) -> str:
        assert self.report is not None
        return self.report.outcome

    @property
    def detail(self) -> str:
        if self.report is None:
            return super().detail
        return "; ".join((*self.report.told, *(check.told for check in self.report.wrong)))

    @property
    def measures(self) -> Mapping[str, float]:
        if self.report is None:
            return {}
        both = (("", self.report.checks), ("back.", self.report.checks_back))
        return {
            f"{way}{name}, {check.unit}": check.value
            for way, checks in both
            for name, check in checks.items()
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class PalletWork:
    """Executes and reverses palletising jobs."""

    blocks: int
    interrupt: bool  # reverse each run after a drawn number of steps
    world: WorldSpec

    def __call__(self, case: Case) -> list[PalletRow]:
        """Run one trial."""
        report = tried(self.blocks, self.interrupt, case.seed, self.world)
        return [PalletRow(trial=case.trials[0], seed=case.seed, report=report)]


def tried(blocks: int, interrupt: bool, seed: int, world: WorldSpec) -> JobReport:
    try:
        runner = Runner(setup_of_job("palletise", msgspec.structs.replace(world, seed=seed), blocks))
    except (Refused, PhysicsFailed) as error:  # the arm cannot reach a place to which it is driven
        return JobReport(job="palletise", seed=seed, blocks=blocks, outcome="stopped", told=(str(error),))
    after = broken_off_after(seed, blocks) if interrupt else None
    return carried_out(runner, after=after)


def broken_off_after(seed: int, blocks: int) -> int:
    """Return the number of steps after which the job is reversed in the world of a seed. The number is random."""
    most = 3 + STEPS * min(blocks, PLACES)
    return int(random_numbers(seed, "pallet.interrupt").integers(1, most, endpoint=True))


def _more(rows: Sequence[PalletRow]) -> dict[str, object]:
    """Return the largest value of each finding in all trials, and the total time on the arm's clock (s)."""
    most: dict[str, float] = {}
    for row in rows:
        for name, value in row.measures.items():
            finding = name.rpartition(", ")[0]
            most[finding] = max(most.get(finding, 0.0), value)
    return {"most": most, "arm_s": _arm_s(rows)}


def _arm_s(rows: Sequence[PalletRow]) -> float:
    return round(sum(row.report.arm_s for row in rows if row.report), 3)


PALLET: Final = Sweep(
    kind="pallet",
    row=PalletRow,
    outcomes={"right": "right", "silent": "silent", "stopped": "wrong", "halted": "wrong"},
    success="right",
    more=_more,
    summary=lambda rows: [f"{_arm_s(rows):.0f} s of simulated time"],
)  # palletising and its reversal
