"""Tries the mutants of a program. The proof comes first. If the proof does not refuse a mutant, the mutant is run with
the faults that the missing check would notice.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Literal

import msgspec

from handeye.core.faults import Fault
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.proof.outcomes import OutcomeGraph
from handeye.proof.proof import prove
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.trials.assembly import run_on
from handeye.trials.mutants.purpose import faults_for
from handeye.trials.mutants.rules import Mutant
from handeye.trials.sound_run import sound_run, with_faults
from handeye.trials.sweep import Case, Sweep, TrialRow

Outcome = Literal["refused", "caught", "unnoticed", "silent", "not run"]
"""The outcome of a mutant.

- refused: the proof names a finding whose failure could escape the notice of the mutant
- caught: the mutant stopped in at least one run, and was silent in none
- unnoticed: in all runs, the mutant ran to its end, and the work is right
- silent: in at least one run, the work is wrong, but the mutant reported success
- not run: the proof does not refuse the mutant, and no run tried the mutant. Either we know no fault that the changed
check is meant to notice, or no runs were requested
"""


class FaultRun(Record, frozen=True, kw_only=True):
    """A run of a mutant with a fault."""

    fault: str  # as it would be typed
    exit_code: int
    message: str  # the call to the operator, or the referee's complaints


class MutantTrial(Record, frozen=True, kw_only=True):
    """The trial of one mutant."""

    name: str
    outcome: Outcome
    findings: tuple[str, ...] = ()  # findings that the proof refuses
    runs: tuple[FaultRun, ...] = ()


class MutantRow(TrialRow, frozen=True, kw_only=True):
    """The row of one mutant. The row's condition is the name of the mutant."""

    tried: MutantTrial | None = None  # None: it did not finish

    @property
    def outcome(self) -> str:
        assert self.tried is not None
        return self.tried.outcome

    @property
    def detail(self) -> str:
        if self.tried is None:
            return super().detail
        if self.tried.findings:
            return f"can leave unnoticed: {', '.join(self.tried.findings)}"
        return "; ".join(f"{run.fault}: {run.message or 'right'}" for run in self.tried.runs) or "no run"


@dataclass(frozen=True, slots=True, kw_only=True)
class MutantWork:
    """Tries mutants. The condition of a case is the name of a mutant."""

    plan: Plan
    world: WorldSpec  # World of every case, without its seed
    mutants: Mapping[str, Mutant]
    camera: str
    sound: Path  # Folder of the fault-free runs
    most: int  # Faults for each mutant, at most; 0: only the proof

    def __call__(self, case: Case) -> list[MutantRow]:
        """Try a mutant."""
        mutant, world = self.mutants[case.condition], msgspec.structs.replace(self.world, seed=case.seed)
        tried = self._tried(mutant, world)
        return [MutantRow(trial=case.trials[0], seed=case.seed, condition=case.condition, tried=tried)]

    def _tried(self, mutant: Mutant, world: WorldSpec) -> MutantTrial:
        work = task(self.plan.task)
        proof = prove(mutant.program, work.obligations(world), self.plan.task)
        if not proof.holds:
            refused = tuple(
                each.finding for each in proof.findings if proof.verdict(each) in ("avoided", "undecided")
            )
            return MutantTrial(name=mutant.name, outcome="refused", findings=refused)
        graph = OutcomeGraph(self.plan.program.steps)
        faults = faults_for(mutant, self.plan.program, graph, work.faults(world), self.most)
        runs = tuple(self._run(mutant, world, fault) for fault in faults)
        return MutantTrial(name=mutant.name, outcome=_outcome(runs), runs=runs)

    def _run(self, mutant: Mutant, world: WorldSpec, fault: Fault) -> FaultRun:
        result = run_on(self._start(mutant, world, fault)).result
        complaints = "; ".join(check.told for check in result.referee.values() if check.refuses)
        return FaultRun(
            fault=task(self.plan.task).faults(world).written(fault),
            exit_code=result.exit_code,
            message=complaints if result.completed else result.message or f"error {result.error}",
        )

    def _start(self, mutant: Mutant, world: WorldSpec, fault: Fault) -> Checkpoint:
        """Return the start of a run of a mutant with `fault`. If the fault is present from the start, the run starts
        at the beginning. If not, the run starts in the state of the sound run before the fault's stage.
        """
        setup = Setup(plan=self.plan, world=world, camera=self.camera)
        changed = msgspec.structs.replace(self.plan, program=mutant.program)
        if fault.stage is None:
            world = msgspec.structs.replace(world, faults=(fault,))
            return Checkpoint(setup=msgspec.structs.replace(setup, plan=changed, world=world))
        start = with_faults(sound_run(self.sound, setup, world).before(fault.stage), (fault,))
        return msgspec.structs.replace(start, setup=msgspec.structs.replace(start.setup, plan=changed))


def _outcome(runs: Sequence[FaultRun]) -> Outcome:
    codes = {run.exit_code for run in runs}
    if not codes:
        return "not run"
    if 3 in codes:
        return "silent"
    return "caught" if codes - {0} else "unnoticed"


def _sentence(row: MutantRow) -> str:
    return f"{row.condition:48}  {row.verdict:9}  {row.detail}".rstrip()


def _summary(rows: Sequence[MutantRow]) -> list[str]:
    counts = Counter(row.verdict for row in rows)
    told = ", ".join(f"{count} {outcome}" for outcome, count in counts.most_common())
    return [f"{counted(len(rows), 'mutant')}: {told}"]


def _more(rows: Sequence[MutantRow]) -> dict[str, object]:
    return {"mutants": [row.tried for row in rows if row.tried]}


MUTANTS: Final = Sweep(
    kind="mutants",
    row=MutantRow,
    outcomes={"refused": "right", "caught": "right", "unnoticed": "wrong", "silent": "silent", "not run": "uncounted"},
    success="refused by the proof, or caught in a run",
    noun="mutant",
    sentence=_sentence,
    summary=_summary,
    more=_more,
)  # fmt: skip
"""Sweep of the mutants of a plan."""
