"""Trials of faults: a job runs with one fault of the machine, and then DIAGNOSE searches for the faulty part."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.errors import Refused
from handeye.core.plain_text import counted
from handeye.core.variation import WorldSpec
from handeye.systems.sigma.diagnosis.bench import Bench
from handeye.systems.sigma.diagnosis.strategy import Strategy
from handeye.systems.sigma.gantries.faults import catalogue, every_fault
from handeye.systems.sigma.run.jobs import job_setup
from handeye.systems.sigma.run.plan import MalPlan
from handeye.systems.sigma.run.system import SIGMA
from handeye.trials.job_faults import judged_run
from handeye.trials.sweep import Case, Sweep, TrialRow

_ENDED: Final = {0: "right", 1: "stopped", 3: "silent"}
_LONGEST: Final = 600.0  # s of simulated time after which a program counts as endless


class MalFaultRow(TrialRow, frozen=True, kw_only=True):
    """The trial of one fault. The row's `condition` names the fault."""

    result: str = ""  # result of the job: right, stopped, endless or silent
    message: str = ""  # why the program stopped, or what the referee found
    part: str = ""  # the part that has the fault
    named: str = ""  # the part that DIAGNOSE names; empty: it cannot decide

    @property
    def outcome(self) -> str:
        if self.result in ("right", "silent", "endless"):
            return self.result
        return "named" if self.named == self.part else "misnamed" if self.named else "stopped"

    @property
    def detail(self) -> str:
        found = f"DIAGNOSE names {self.named or 'no part'}"
        return super().detail or "; ".join(filter(None, (self.message, found)))


@dataclass(frozen=True, slots=True, kw_only=True)
class MalFaultWork:
    """Runs a job once for each fault. Each case is a run with one fault, which is named in the case's `condition`."""

    plan: MalPlan
    world: WorldSpec

    def __call__(self, case: Case) -> list[MalFaultRow]:
        """Run the job with the fault, then diagnose a machine with the same fault."""
        planted = every_fault()[case.condition]
        fault = catalogue().kind(case.condition).usual()
        world = msgspec.structs.replace(self.world, seed=case.seed, faults=(fault,))
        _, result = judged_run(job_setup(self.plan, world), _LONGEST)
        named = Strategy(Bench(planted, case.seed)).diagnose().part
        row = MalFaultRow(
            trial=case.trials[0], seed=case.seed, condition=case.condition, part=planted.part, named=named
        )
        if result is None:
            message = f"the program is still running after {_LONGEST:g} s"
            return [msgspec.structs.replace(row, result="endless", message=message)]
        wrong = [check.told for check in result.referee.values() if check.refuses]
        message = "; ".join(wrong) if result.completed else result.message
        return [msgspec.structs.replace(row, result=_ENDED[result.exit_code], message=message)]


def fault_trials(task: str, world: WorldSpec) -> tuple[Sweep[MalFaultRow], MalFaultWork]:
    """Return the trials of a job with each of its faults, and the function that makes one trial. Raises Refused if no
    referee judges the task.
    """
    plan = SIGMA.own_plan(task)
    if not plan.pieces:
        raise Refused(
            f"faults cannot be tried in the task {quoted(task)}, because no referee judges the outcome of this task"
        )
    return MAL_FAULTS, MalFaultWork(plan=plan, world=world)


def _sentence(row: MalFaultRow) -> str:
    return f"{row.condition:24}  {row.verdict:9}  {row.detail}"


def _summary(rows: Sequence[MalFaultRow]) -> list[str]:
    counts = Counter(row.verdict for row in rows)
    told = ", ".join(f"{count} {outcome}" for outcome, count in counts.most_common())
    named = sum(row.named == row.part for row in rows if not row.broken_off)
    return [
        f"{counted(len(rows), 'fault')}: {told}; {counts['silent']} silent",
        f"DIAGNOSE names the right part for {named} of {counted(len(rows), 'fault')}",
    ]


def _more(rows: Sequence[MalFaultRow]) -> dict[str, object]:
    tried = sorted((row for row in rows if not row.broken_off), key=lambda row: row.condition)
    return {
        "undetected": sum(row.result == "silent" for row in tried),
        "faults": [
            {
                "name": row.condition,
                "outcome": row.outcome,
                "message": row.message,
                "part": row.part,
                "named": row.named,
            }
            for row in tried
        ],
    }


MAL_FAULTS: Final = Sweep(
    kind="mal_faults",
    row=MalFaultRow,
    outcomes={
        "right": "right", "named": "right", "stopped": "wrong", "misnamed": "wrong", "endless": "wrong",
        "silent": "silent",
    },
    success="right, or stopped with the faulty part named by DIAGNOSE",
    noun="fault",
    sentence=_sentence,
    summary=_summary,
    more=_more,
)  # fmt: skip
"""The trials of a job, each with one fault."""
