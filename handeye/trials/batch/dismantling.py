"""Trials of dismantling: a pump is built, in part or wholly, and the arm undoes what it did."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from handeye.core.host_time import HostTimer
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.judge.finding import all_right
from handeye.program.events import UndoFinished
from handeye.results.finishing import finished
from handeye.results.judging import findings
from handeye.runs.advance import Pause, advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.stops import AfterStage
from handeye.trials.assembly import Finished
from handeye.trials.batch.distributions import Margin, margins
from handeye.trials.batch.figures import Cause, Failure, causes_of, failures_of
from handeye.trials.batch.rates import rate
from handeye.trials.batch.row import Row
from handeye.trials.batch.trial import Trial, Watch, facts


@dataclass(frozen=True, slots=True, kw_only=True)
class DismantlingTrial(Trial):
    """Builds by a plan, has the arm undo all of it, and asks the referee whether everything is where it was."""

    to: str = ""
    """The stage behind which it begins to undo; empty: the program comes to its end."""

    @property
    def work(self) -> str:
        return f"dismantle after {self.to or 'the last stage'}"

    def _facts(self, world: WorldSpec, timer: HostTimer, watch: Watch) -> dict[str, object]:
        setup = Setup(plan=self.plan, world=world, camera=self.camera, without=self.without, judged=True)
        runner = Runner(Checkpoint(setup=setup), observers=watch.looking_on, halt=watch.over)
        pause = advance(runner, self._stops())
        built = _built(runner, pause)
        if built:
            runner.order_reversal(0, halts=True)
            pause = advance(runner)
        done = Finished(result=finished(runner, pause, Meter(timer=timer), judged=True), runner=runner)
        ended = "not built" if not built and watch.ended == "ended" else watch.ended
        met = [event.force for event in runner.events if isinstance(event, UndoFinished)]
        return facts(done, ended) | {"force": max(met, default=None)}

    def _stops(self) -> tuple[AfterStage, ...]:
        stages = self.plan.program.stages
        return (AfterStage(stage=stages.index(self.to), name=self.to),) if self.to else ()


def _built(runner: Runner, pause: Pause) -> bool:
    """There is what is to be taken apart, and it is right as far as the referee can tell."""
    return pause.kind == "break" or (pause.kind == "end" and all_right(findings(runner, pause)))


class DismantlingFigures(Record, frozen=True, kw_only=True):
    """What trials of dismantling come to; those in which nothing was built count in `not_built` alone."""

    n: int
    """Trials in which something was built."""
    apart: int
    silent_failures: int
    """Trials in which all was undone, and the referee disagreed."""
    stopped: int
    """Trials in which a guard stopped it and called the operator."""
    failed: int
    """Trials that broke off: by an exception, at a limit, or because their process was killed twice."""
    not_built: int
    killed: int
    """How often the process of a trial was killed."""
    wilson95: tuple[float, float] | None
    """Wilson's interval of the probability that a pump is taken apart."""
    p_s: float | None
    """Lower bound of the same, 95 % one-sided, exact."""
    force: float | None
    """Greatest force that the hand met, N, in trials in which it came apart."""
    failures: tuple[Failure, ...]
    causes: tuple[Cause, ...]
    """Of the failures, the most frequent first."""
    margins: tuple[Margin, ...]
    """To the limits of the referee; the next to fail first."""
    cpu_s: float
    """Of all trials."""
    wall_s: float
    """Of the host, since this command began."""


def dismantling_figures(
    rows: Sequence[Row], command: Callable[[Row], str], *, wall_s: float = 0.0
) -> DismantlingFigures:
    """The figures of some rows.

    Args:
        command: the command that carries a trial out again.
    """
    built = [row for row in rows if row.verdict != "not built"]
    counts = Counter(row.verdict for row in built)
    sure = rate(counts["apart"], len(built))
    failures = failures_of(built, command, "apart")
    forces = [row.force for row in built if row.verdict == "apart" and row.force is not None]
    return DismantlingFigures(
        n=len(built),
        apart=counts["apart"],
        silent_failures=counts["silent"],
        stopped=counts["stopped"],
        failed=counts["failed"],
        not_built=len(rows) - len(built),
        killed=sum(row.killed for row in rows),
        wilson95=sure.wilson95,
        p_s=sure.p_s,
        force=max(forces, default=None),
        failures=failures,
        causes=causes_of(failures),
        margins=margins(built),
        cpu_s=round(sum(row.cpu_s for row in rows), 3),
        wall_s=round(wall_s, 3),
    )
