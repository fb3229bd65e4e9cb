"""Advances a run step by step until it ends or a stop condition pauses it. The observers of the run receive each state
that must be kept.
"""

from collections.abc import Callable, Sequence
from typing import Literal

from handeye.core.record import Record
from handeye.execution.servo import Halted
from handeye.program.diagnosis.causes import Cause
from handeye.program.events import AnyEvent, ErrorRaised, StageFinished, UndoEnded
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Snapshot


class StopCondition(Record, frozen=True, kw_only=True, tag_field="stop", tag=True):
    """Base class of the stop conditions. The base class itself never pauses a run."""

    def met_before(self, runner: Runner) -> bool:
        """Return True if the run must pause before the next step."""
        return False

    def met_after(self, events: Sequence[AnyEvent]) -> bool:
        """Return True if the run must pause after the step that emitted these events."""
        return False


class AtSteps(StopCondition, frozen=True, kw_only=True):
    """Pause before each step whose number is in `steps`."""

    steps: tuple[int, ...]

    def met_before(self, runner: Runner) -> bool:
        return runner.at in self.steps


class AtLine(AtSteps, frozen=True, kw_only=True):
    """Pause before each step on the line `line` of the main source text or of a required file."""

    file: str
    line: int


class AtLabel(AtSteps, frozen=True, kw_only=True):
    """Pause before each step with the label `label`."""

    label: str


class AtInstruction(AtSteps, frozen=True, kw_only=True):
    """Pause before each step whose statement begins with the instruction word `word`."""

    word: str


class BeforeStep(AtSteps, frozen=True, kw_only=True):
    """Pause before one step."""

    @property
    def step(self) -> int:
        """Number of the step."""
        return self.steps[0]


class AtStage(StopCondition, frozen=True, kw_only=True):
    """Pause when a stage, given by its index and its name, is about to begin."""

    stage: int
    name: str

    def met_before(self, runner: Runner) -> bool:
        return runner.between_stages and runner.next is not None and runner.next.stage == self.stage


class OnError(StopCondition, frozen=True, kw_only=True):
    """Pause after a step that raised error `number`."""

    number: int

    def met_after(self, events: Sequence[AnyEvent]) -> bool:
        return any(isinstance(event, ErrorRaised) and event.number == self.number for event in events)


class AfterStage(StopCondition, frozen=True, kw_only=True):
    """Pause when a stage, given by its index and its name, has ended."""

    stage: int
    name: str

    def met_before(self, runner: Runner) -> bool:
        last = runner.events[-1]
        return isinstance(last, StageFinished) and last.stage == self.name


class ReversalEnd(StopCondition, frozen=True, kw_only=True, tag="Undone"):
    """Pause when the arm has undone all the steps that it was asked to undo."""

    def met_before(self, runner: Runner) -> bool:
        return isinstance(runner.events[-1], UndoEnded)


class AfterSteps(StopCondition, frozen=True, kw_only=True):
    """Pause after `count` steps. The caller counts the steps."""

    count: int


class PauseRequest(StopCondition, frozen=True, kw_only=True, tag="Asked"):
    """Pause because a person asked for a pause during the run."""


class ByHand(StopCondition, frozen=True, kw_only=True):
    """Pause because the user ended the stepping session before the run had ended."""


class DriverFailure(StopCondition, frozen=True, kw_only=True, tag="BrokenOff"):
    """Pause because the program that controls the run failed."""

    exception: str  # class name


AnyStop = (
    AtLine
    | AtLabel
    | AtInstruction
    | BeforeStep
    | AtStage
    | OnError
    | AfterStage
    | ReversalEnd
    | AfterSteps
    | PauseRequest
    | ByHand
    | DriverFailure
)


class Pause(Record, frozen=True, kw_only=True):
    """The reason why a run paused."""

    kind: Literal["end", "operator", "trouble", "break", "panic"]  # `trouble`: it cannot continue
    done: int = 0  # steps done since the run continued
    next: int | None = None  # the step to be done next; None if the run cannot continue alone
    met: AnyStop | None = None  # the stop condition, if one was met
    error: int | None = None  # number of the error for which the operator is called
    cause: Cause | None = None  # cause of the error, or of a call without an error
    message: str = ""  # message of the program to the operator, or of the cell that cannot continue
    undone: bool = False  # the arm has undone all the steps that it was ordered to undo
    back: bool = False  # the panic button was pressed while the run went back to an earlier state


def advance(
    runner: Runner,
    stops: Sequence[AnyStop] = (),
    steps: int | None = None,
    asked: Callable[[], bool] = lambda: False,
) -> Pause:
    """Execute `steps` steps (at least one). If `steps` is not given, continue until the run ends. `asked`
    is called after each step. If `asked` returns True, the run pauses. Returns the reason why the run paused.
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
    """Return the pause if a stop condition is met before the next step, or None if no stop condition is met. If the
    run pauses, its state is kept.
    """
    met = next((stop for stop in stops if stop.met_before(runner)), None)
    if met is None:
        return None
    keep(runner, runner.history[-1])
    return Pause(kind="break", done=done, next=runner.at, met=met)


def _step(runner: Runner, stops: Sequence[AnyStop], done: int) -> Pause | None:
    """Execute one step. Returns the pause that follows the step, or None if no pause follows."""
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
    """Return the reason why a run cannot continue without the operator."""
    if runner.trouble is not None:
        return Pause(kind="trouble", done=done, message=runner.trouble)
    call = runner.call
    if call is not None:
        return Pause(kind="operator", done=done, error=call.error, cause=call.cause, message=call.message)
    return Pause(kind="end", done=done, undone=runner.undone)


def keep(runner: Runner, snapshot: Snapshot) -> None:
    """Pass a state of the run to the observers that keep states."""
    checkpoint = runner.checkpoint(snapshot)
    for observer in runner.observers:
        observer.checkpoint(checkpoint)
