"""Trials of dismantling: a pump is built, in part or wholly, and the arm undoes what it did."""

from dataclasses import dataclass
from typing import Final

from handeye.core.host_time import HostTimer
from handeye.core.variation import WorldSpec
from handeye.judge.finding import all_right
from handeye.program.events import UndoFinished
from handeye.results.finishing import finished
from handeye.results.judging import findings
from handeye.runs.advance import AfterStage, Pause, advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trials.assembly import FinishedRun
from handeye.trials.plans.distributions import margin_details
from handeye.trials.plans.row import APART, Row
from handeye.trials.plans.trial import Trial, Watch, facts
from handeye.trials.sweep import Sweep


@dataclass(frozen=True, slots=True, kw_only=True)
class DismantlingTrial(Trial):
    """Builds by a plan, has the arm undo all of it, and asks the referee whether everything is where it was."""

    to: str = ""
    """The stage behind which it begins to undo; empty: the program comes to its end."""

    @property
    def settings(self) -> dict[str, str]:
        return {"stage to undo from": self.to}

    def _facts(self, world: WorldSpec, timer: HostTimer, watch: Watch) -> dict[str, object]:
        setup = Setup(plan=self.plan, world=world, camera=self.camera, without=self.without, judged=True)
        runner = Runner(Checkpoint(setup=setup), observers=watch.looking_on, halt=watch.over)
        pause = advance(runner, self._stops())
        built = _built(runner, pause)
        if built:
            runner.order_reversal(0, halts=True)
            pause = advance(runner)
        done = FinishedRun(result=finished(runner, pause, Meter(timer=timer), judged=True), runner=runner)
        ended = "not built" if not built and watch.ended == "ended" else watch.ended
        met = [event.force for event in runner.events if isinstance(event, UndoFinished)]
        return facts(done, ended) | {"force": max(met, default=None)}

    def _stops(self) -> tuple[AfterStage, ...]:
        stages = self.plan.program.stages
        return (AfterStage(stage=stages.index(self.to), name=self.to),) if self.to else ()


def _built(runner: Runner, pause: Pause) -> bool:
    """There is what is to be taken apart, and it is right as far as the referee can tell."""
    return pause.kind == "break" or (pause.kind == "end" and all_right(findings(runner, pause)))


DISMANTLING: Final = Sweep(
    kind="dismantling",
    row=Row,
    outcomes=APART,
    success="apart",
    narrated=True,
    details=lambda rows: (margin_details([row for row in rows if row.verdict != "not built"]),),
)
"""Programs carried out and undone by the arm."""
