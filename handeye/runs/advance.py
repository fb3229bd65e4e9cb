"""Going on, step after step, until there is a reason to stop; states worth keeping are handed to the observers."""

from collections.abc import Sequence
from typing import Literal, Protocol

from handeye.events import AnyEvent
from handeye.execution.drive import Halted
from handeye.record import Record
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Snapshot


class Stop(Protocol):
    """A reason to stop."""

    def before(self, runner: Runner) -> str | None:
        """Why to stop before the next step, in words."""

    def after(self, events: Sequence[AnyEvent]) -> str | None:
        """Why to stop behind a step in which these events happened."""


class Pause(Record, frozen=True, kw_only=True):
    """Why a run stands still."""

    kind: Literal["end", "operator", "trouble", "break", "panic"]
    """The program came to its end, called the operator, cannot go on; a reason to stop was met; panic button."""
    sentence: str


def advance(runner: Runner, stops: Sequence[Stop] = (), steps: int | None = None) -> Pause:
    """Do `steps` steps, or all that are left, but at least one before a reason to stop counts."""
    done = 0
    while not runner.ended:
        if runner.executor.between_stages:
            keep(runner, runner.history[-1])
        sentence = _step(runner, stops)
        if sentence is not None:
            return sentence
        done += 1
        if done == steps:
            return Pause(
                kind="end" if runner.ended else "break",
                sentence=f"{done} step{'' if done == 1 else 's'} done",
            )
        reason = next((why for stop in stops if (why := stop.before(runner)) is not None), None)
        if reason is not None and not runner.ended:
            keep(runner, runner.history[-1])
            return Pause(kind="break", sentence=reason)
    return _ended(runner)


def _step(runner: Runner, stops: Sequence[Stop]) -> Pause | None:
    """One step; why to stop behind it."""
    happened = len(runner.events)
    try:
        runner.step()
    except Halted:
        keep(runner, runner.history[-1])
        return Pause(kind="panic", sentence="stopped by hand; the brakes are set")
    if runner.ended:
        pause = _ended(runner)
        keep(runner, runner.history[-2 if pause.kind == "operator" else -1])
        return pause
    events = runner.events[happened:]
    reason = next((why for stop in stops if (why := stop.after(events)) is not None), None)
    if reason is None:
        return None
    keep(runner, runner.history[-1])
    return Pause(kind="break", sentence=reason)


def _ended(runner: Runner) -> Pause:
    if runner.trouble is not None:
        return Pause(kind="trouble", sentence=runner.trouble)
    called = runner.executor.state.stopped
    if called is not None:
        return Pause(kind="operator", sentence=called.message)
    return Pause(kind="end", sentence="the program came to its end")


def keep(runner: Runner, snapshot: Snapshot) -> None:
    """Hand a state that the run has been in to those who keep states."""
    checkpoint = runner.checkpoint(snapshot)
    for observer in runner.observers:
        observer.checkpoint(checkpoint)
