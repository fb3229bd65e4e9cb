"""Trials of undoing in a disturbed cell. The arm builds the product, the cell is disturbed, and the arm then undoes
its work. The trials show whether a guard stops the arm before the arm does harm.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from msgspec.structs import replace

from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.program.diagnosis.causes import UndoResisted
from handeye.program.events import UndoFinished, UndoStarted
from handeye.results.finishing import finished
from handeye.runs.advance import AfterStage, advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.tasks.interface import Disturbance
from handeye.trials.assembly import brakes_hold
from handeye.trials.sweep import Case, Sweep, TrialRow

MOVED: Final = 2.0  # mm, greatest permitted movement of a part that the hand does not hold
FORCE: Final = 60.0  # N, greatest permitted force on the hand


class DisturbanceResult(Record, frozen=True, kw_only=True):
    """The result of one reversal after a disturbance."""

    name: str
    built: bool  # The pump was built as far as the disturbance needs; if not, the other fields mean nothing
    stopped: bool = False  # A guard stopped the arm, and the brakes are on
    at: str = ""  # The statement that was being undone
    line: str = ""
    message: str = ""  # The call to the operator, or the referee’s complaint
    moved: float = 0.0  # Greatest movement, in one step, of a part that was not held, mm
    part: str = ""
    felt: float = 0.0  # Greatest force that the hand felt, N

    @property
    def harmless(self) -> bool:
        """True if the arm was stopped before the arm did harm."""
        return self.stopped and self.moved <= MOVED and self.felt <= FORCE


class DisturbanceRow(TrialRow, frozen=True, kw_only=True):
    """One trial with one disturbance. The field `condition` of the row names the disturbance."""

    tried: DisturbanceResult | None = None  # None: it did not finish

    @property
    def outcome(self) -> str:
        if self.tried is None or not self.tried.built:
            return "not built"
        return "stopped in time" if self.tried.harmless else "not in time"

    @property
    def detail(self) -> str:
        return super().detail if self.tried is None else self.tried.message

    @property
    def measures(self) -> Mapping[str, float]:
        if self.tried is None or not self.tried.built:
            return {}
        return {"felt, N": self.tried.felt, "moved, mm": self.tried.moved}


@dataclass(frozen=True, slots=True, kw_only=True)
class DisturbanceWork:
    """For each case, executes a plan, disturbs the product, and lets the arm undo the work."""

    plan: Plan
    world: WorldSpec  # World of every case, without its seed
    camera: str

    def __call__(self, case: Case) -> list[DisturbanceRow]:
        """Try one disturbance."""
        world = replace(self.world, seed=case.seed)
        tried = disturbed(self.plan, world, self.camera, case.condition)
        return [DisturbanceRow(trial=case.trials[0], seed=case.seed, condition=case.condition, tried=tried)]


def disturbed(plan: Plan, world: WorldSpec, camera: str, name: str) -> DisturbanceResult:
    """Execute the plan, disturb its product, let the arm undo the work, and judge the result."""
    change = next(each for each in task(plan.task).disturbances() if each.name == name)
    runner = Runner(Checkpoint(setup=Setup(plan=plan, world=world, camera=camera, judged=True)))
    if not _built(runner, plan, change):
        return DisturbanceResult(name=name, built=False)
    change.make(runner.arm_cell)
    begun, moved, part = len(runner.events), 0.0, ""
    runner.order_reversal(0, halts=True)
    while not runner.ended:
        moved, part = max((moved, part), _moved(runner))
    result = finished(runner, advance(runner), Meter(), judged=True)
    undone = [event for event in runner.events[begun:] if isinstance(event, UndoStarted)]
    met = [event.force for event in runner.events[begun:] if isinstance(event, UndoFinished)]
    cause = None if runner.call is None else runner.call.cause
    wrong = "; ".join(check.told for check in result.referee.values() if check.refuses)
    judged = wrong or "the arm undid all its work, and every part is back in its place"
    return DisturbanceResult(
        name=name,
        built=True,
        stopped=runner.call is not None and brakes_hold(runner.arm_cell),
        at=undone[-1].text if undone else "",
        line=undone[-1].place if undone else "",
        message=judged if runner.call is None else result.message,
        moved=round(moved, 3),
        part=part,
        felt=round(max([*met, cause.force] if isinstance(cause, UndoResisted) else met, default=0.0), 2),
    )


def _built(runner: Runner, plan: Plan, change: Disturbance) -> bool:
    """Execute the plan as far as the disturbance requires. Returns True if this part of the plan succeeded."""
    stages = plan.program.stages
    number = len(stages) if change.after is None else change.after
    pause = advance(
        runner, () if number == len(stages) else (AfterStage(stage=number - 1, name=stages[number - 1]),)
    )
    return runner.call is None and pause.kind in ("end", "break")


def _moved(runner: Runner) -> tuple[float, str]:
    """Execute a step, and find the part that the step moved farthest. Parts that the hand holds before or after the
    step do not count. Returns the displacement (mm) and the name of the part that moved farthest.
    """
    work = task(runner.setup.task)
    before = work.bystanders(runner.cell.truth)
    runner.step()
    after = work.bystanders(runner.cell.truth)
    ways = [
        (1000 * float(np.linalg.norm(after[part] - before[part])), part)
        for part in before.keys() & after.keys()
    ]
    return max(ways, default=(0.0, ""))


def _sentence(row: DisturbanceRow) -> str:
    found = row.tried
    if found is None:
        return f"{row.condition:16} {row.verdict}: {row.detail}"
    if not found.built:
        return f"{found.name:16} not tried: the pump was not built"
    how = "stopped in time" if found.harmless else "stopped" if found.stopped else "NOT STOPPED"
    where = f", line {found.line}, {' '.join(found.at.split())}" if found.stopped else ""
    met = f"felt {found.felt:.1f} N, moved {found.moved:.2f} mm"
    return f"{found.name:16} {how}{where}: {found.message}; {met}"


def _more(rows: Sequence[DisturbanceRow]) -> dict[str, object]:
    tried = [row.tried for row in rows if row.tried]
    return {"harmless": sum(each.harmless for each in tried if each.built), "disturbances": tried}


DISTURBED: Final = Sweep(
    kind="disturbed",
    row=DisturbanceRow,
    outcomes={"stopped in time": "right", "not in time": "silent", "not built": "uncounted"},
    success="stopped in time",
    noun="disturbance",
    sentence=_sentence,
    more=_more,
)
