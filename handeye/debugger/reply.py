"""Answer of the stepper to a command, as one plain record: programs read it as JSON, people as text."""

from msgspec import UNSET, UnsetType

from handeye.core.record import Record
from handeye.debugger.listing import SourceLine
from handeye.debugger.step_summary import StepSummary
from handeye.debugger.view_records import Shown, TaskView
from handeye.program.events import AnyEvent
from handeye.runs.advance import Pause
from handeye.runs.stops import AnyStop


class Break(Record, frozen=True, kw_only=True):
    """A breakpoint, and the number to delete it by."""

    number: int
    stop: AnyStop


class CommandResult(Record, frozen=True, kw_only=True):
    """Result of a command; fields with nothing to say are left out."""

    said: str | UnsetType = UNSET
    """A sentence or more."""
    pause: Pause | None = None
    """Why the run pauses, if the command made it go."""
    source: tuple[SourceLine, ...] | UnsetType = UNSET
    """The script around the line where the run stands, or around one that was asked for."""
    show: Shown | UnsetType = UNSET
    breaks: tuple[Break, ...] | UnsetType = UNSET
    file: str | UnsetType = UNSET
    """File that was written."""


class UnderWay(Record, frozen=True, kw_only=True):
    """A step that begins; names are those of `Reply`."""

    position: int
    time: float
    stage: str
    stage_number: int
    step: int
    line: int
    text: str
    script: str = ""


class Reply(CommandResult, frozen=True, kw_only=True):
    """The answer to a command: where the run now stands, and what came of the command."""

    command: str
    position: int
    """Steps done since the run began."""
    time: float
    """s since the working phase began."""
    stage: str | None
    """The stage under way, or the one about to begin; None after the last."""
    stage_number: int | None
    """From 1."""
    step: int | None
    """The step to be done next; None if the run cannot go on by itself."""
    line: int | None
    text: str | None
    """Its statement."""
    script: str = ""
    """The required file its line is in; empty: the script itself."""
    tasks: tuple[TaskView, ...] | UnsetType = UNSET
    """Places of the tasks of a system that has several."""
    did: tuple[StepSummary, ...] = ()
    """Steps that were done, in words."""
    events: tuple[AnyEvent, ...] = ()
    """Events that have happened, in full."""
    error: str | None = None
    """Why the command was not carried out."""
