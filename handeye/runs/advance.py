"""Advance a run step by step until it pauses; states worth keeping go to the observers."""

from collections.abc import Callable, Sequence
from typing import Literal

from handeye.core.record import Record
from handeye.execution.servo import Halted
from handeye.program.diagnosis.causes import Cause
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Snapshot
from handeye.runs.stops import AfterSteps, AnyStop, PauseRequest


class Pause(Record, frozen=True, kw_only=True):
    """Reason of a pause, as facts."""

    kind: Literal["end", "operator", "trouble", "break", "panic"]
    """The program ended, called the operator, cannot go on; a stop condition was met; the panic button."""
    done: int = 0
    """Steps done since the run went on."""
    next: int | None = None
    """The step to be done next; None if the run cannot go on by itself."""
    met: AnyStop | None = None
    """The stop condition, if one was met."""
    error: int | None = None
    """The error that the operator is called for."""
    cause: Cause | None = None
    """Cause of that error, or of a call for none."""
    message: str = ""
    """The program's own words to the operator, or those of the cell that cannot go on."""
    undone: bool = False
    """It ended where the arm has undone what it was to undo."""
    back: bool = False
    """The panic button was hit on the way back in time."""


def advance(
    runner: Runner,
    stops: Sequence[AnyStop] = (),
    steps: int | None = None,
    asked: Callable[[], bool] = lambda: False,
) -> Pause:
    """Do `steps` steps, or all that are left, but at least one before a stop condition counts.

    Args:
        asked: asked after each step whether to pause there.
    """
    done = 0
    while not runner.ended:
        if runner.between_stages:
            keep(runner, runner.history[-1])
        pause = _step(runner, stops, done)
        if pause is not None:
            return pause
        done += 1
        if done == steps:
            return Pause(kind="break", done=done, next=runner.at, met=AfterSteps(count=done))
        pause = None if runner.ended else paused_before(runner, stops, done)
        if pause is not None:
            return pause
        if not runner.ended and asked():
            keep(runner, runner.history[-1])
            return Pause(kind="break", done=done, next=runner.at, met=PauseRequest())
    return ended(runner, done)


def paused_before(runner: Runner, stops: Sequence[AnyStop], done: int = 0) -> Pause | None:
    """The pause before the next step, if a condition asks for one; the state is kept then."""
    met = next((stop for stop in stops if stop.met_before(runner)), None)
    if met is None:
        return None
    keep(runner, runner.history[-1])
    return Pause(kind="break", done=done, next=runner.at, met=met)


def _step(runner: Runner, stops: Sequence[AnyStop], done: int) -> Pause | None:
    """Do one step; the pause after it, if there is one."""
    happened = len(runner.events)
    try:
        runner.step()
    except Halted:
        keep(runner, runner.history[-1])
        return Pause(kind="panic", done=done, next=runner.at)
    done += 1
    if runner.ended:
        pause = ended(runner, done)
        keep(runner, runner.history[-2 if pause.kind == "operator" else -1])
        return pause
    events = runner.events[happened:]
    met = next((stop for stop in stops if stop.met_after(events)), None)
    if met is None:
        return None
    keep(runner, runner.history[-1])
    return Pause(kind="break", done=done, next=runner.at, met=met)


def ended(runner: Runner, done: int = 0) -> Pause:
    """Why a run cannot go on by itself."""
    if runner.trouble is not None:
        return Pause(kind="trouble", done=done, message=runner.trouble)
    call = runner.call
    if call is not None:
        return Pause(kind="operator", done=done, error=call.error, cause=call.cause, message=call.message)
    return Pause(kind="end", done=done, undone=runner.undone)


def keep(runner: Runner, snapshot: Snapshot) -> None:
    """Hand a state of the run to the observers that keep states."""
    checkpoint = runner.checkpoint(snapshot)
    for observer in runner.observers:
        observer.checkpoint(checkpoint)
