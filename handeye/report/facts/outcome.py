"""Determines the outcome of a run, and the moment that decided it."""

from dataclasses import dataclass
from typing import Literal

from handeye.program.events import (
    OperatorAnswered,
    OperatorCalled,
    PanicStopped,
    RunFinished,
    StepFinished,
    StepStarted,
)
from handeye.report.recorded import RecordedRun
from handeye.results.result import Check

Kind = Literal["right", "wrong", "ended", "stopped", "panic", "paused", "broken off"]
"""The outcome of a run. If the program ended: `right` if the referee accepts the work, `wrong` if the referee rejects
the work, and `ended` if the referee has not judged the work. If the program did not end: `stopped` if the program
called the operator, `panic` if the panic button was pressed, `paused` if the run can go on, and `broken off` if the
trace is incomplete.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """The outcome of a run."""

    kind: Kind
    time: float  # The moment to look at first, s since the run began
    stage: str | None = None
    step: StepStarted | None = None  # The step in progress at that time, or the last step before
    call: OperatorCalled | None = None
    wrong: tuple[Check, ...] = ()
    doubts: tuple[Check, ...] = ()  # Failed findings that are only warnings

    @property
    def good(self) -> bool:
        """True if no failure of the run is known."""
        return self.kind in ("right", "ended")

    @property
    def failed(self) -> bool:
        """True if the work is wrong, or the run was stopped."""
        return self.kind in ("wrong", "stopped", "panic")

    @property
    def ended(self) -> bool:
        """True if the program reached its end."""
        return self.kind in ("right", "wrong", "ended")


def outcome(run: RecordedRun) -> Outcome:
    """Return the outcome of a run."""
    last = run.trace.events[-1]
    if isinstance(last, RunFinished) and last.completed:
        return _ended(run)
    stage, step, call = _standing(run)
    kind: Kind = "paused"
    if not run.whole:
        kind, call = "broken off", None
    elif isinstance(last, PanicStopped):
        kind, call = "panic", None
    elif call is not None:
        kind = "stopped"
    return Outcome(kind=kind, time=run.ends, stage=stage, step=step, call=call)


def _ended(run: RecordedRun) -> Outcome:
    """Return the outcome of a run whose program reached its end."""
    judged = None if run.result is None else run.result.judged
    if run.result is None or judged is None:
        return Outcome(kind="ended", time=run.ends)
    checks = run.result.checks
    return Outcome(
        kind="right" if judged else "wrong",
        time=run.ends,
        wrong=tuple(check for check in checks if check.refuses),
        doubts=tuple(check for check in checks if not check.ok and check.caution),
    )


def _standing(run: RecordedRun) -> tuple[str | None, StepStarted | None, OperatorCalled | None]:
    """Return the present stage and step of a run, and the call to the operator that has not been answered yet."""
    stages = run.trace.stages
    step: StepStarted | None = None
    call: OperatorCalled | None = None
    for event in run.trace.events:
        match event:
            case StepStarted():
                step, call = event, None
            case OperatorCalled():
                call = event
            case OperatorAnswered() | StepFinished():
                call = None
    return stages[-1].name if stages else None, step, call
