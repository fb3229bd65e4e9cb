"""Conditions that pause a run, as facts: a breakpoint, the end of a stage, a number of steps."""

from collections.abc import Sequence

from handeye.core.record import Record
from handeye.program.events import AnyEvent, ErrorRaised, StageFinished, UndoEnded
from handeye.runs.runner import Runner


class StopCondition(Record, frozen=True, kw_only=True, tag_field="stop", tag=True):
    """Base of the conditions; one by itself never pauses a run."""

    def met_before(self, runner: Runner) -> bool:
        """Pause before the step that is next."""
        return False

    def met_after(self, events: Sequence[AnyEvent]) -> bool:
        """Pause after a step in which these events happened."""
        return False


class AtSteps(StopCondition, frozen=True, kw_only=True):
    """Pause before any of some steps, given by their numbers."""

    steps: tuple[int, ...]

    def met_before(self, runner: Runner) -> bool:
        return runner.at in self.steps


class AtLine(AtSteps, frozen=True, kw_only=True):
    """Pause before the steps on a line of the source, or of a required file."""

    file: str
    line: int


class AtLabel(AtSteps, frozen=True, kw_only=True):
    """Pause before the steps that a label stands before."""

    label: str


class AtInstruction(AtSteps, frozen=True, kw_only=True):
    """Pause before the steps that begin with an instruction word."""

    word: str


class BeforeStep(AtSteps, frozen=True, kw_only=True):
    """Pause before one step."""

    @property
    def step(self) -> int:
        """Its number."""
        return self.steps[0]


class AtStage(StopCondition, frozen=True, kw_only=True):
    """Pause when a stage, given by its index and name, is about to begin."""

    stage: int
    name: str

    def met_before(self, runner: Runner) -> bool:
        return runner.between_stages and runner.next is not None and runner.next.stage == self.stage


class OnError(StopCondition, frozen=True, kw_only=True):
    """Pause after the step that raised an error."""

    number: int

    def met_after(self, events: Sequence[AnyEvent]) -> bool:
        return any(isinstance(event, ErrorRaised) and event.number == self.number for event in events)


class AfterStage(StopCondition, frozen=True, kw_only=True):
    """Pause when a stage, given by its index and name, has ended."""

    stage: int
    name: str

    def met_before(self, runner: Runner) -> bool:
        last = runner.events[-1]
        return isinstance(last, StageFinished) and last.stage == self.name


class ReversalEnd(StopCondition, frozen=True, kw_only=True, tag="Undone"):
    """Pause when the arm has undone as much as was ordered."""

    def met_before(self, runner: Runner) -> bool:
        return isinstance(runner.events[-1], UndoEnded)


class AfterSteps(StopCondition, frozen=True, kw_only=True):
    """Pause after a number of steps, which the caller counts."""

    count: int


class PauseRequest(StopCondition, frozen=True, kw_only=True, tag="Asked"):
    """Pause because a person asked for it during the run."""


class ByHand(StopCondition, frozen=True, kw_only=True):
    """Pause because a person left the run as it was."""


class DriverFailure(StopCondition, frozen=True, kw_only=True, tag="BrokenOff"):
    """Pause because the program that drives the run failed."""

    exception: str
    """The class of what it raised."""


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
