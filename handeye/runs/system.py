"""System: what a folder of `handeye/systems` offers; and RunningSystem: what a run drives, steps, keeps and puts back.

A system is found by its entry (`handeye/core/entries.py`), and is loaded when a run of it is.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol

import msgspec
import numpy as np

from handeye.core.entries import Entry, entry_named, refusal
from handeye.core.errors import BadFile, Refused
from handeye.core.record import Record
from handeye.execution.context import ExecutionContext, Stopwatch
from handeye.execution.servo import ServoPeriod
from handeye.execution.state import ReversalOrder, Shot
from handeye.judge.finding import Findings
from handeye.planfile.store import written_digest
from handeye.ports.axes import Channel
from handeye.program.events import AnyEvent, Choice
from handeye.program.operation import Device
from handeye.program.system_state import SystemState
from handeye.runs.parts import OWN, Parts
from handeye.runs.setup import Setup
from handeye.vision.calibration import Calibration
from handeye.vision.marks import Mark

if TYPE_CHECKING:
    from handeye.cell.simulated import SimulatedCell
    from handeye.cell.snapshot_cell import SnapshotCell
    from handeye.runs.advance import Pause
    from handeye.runs.runner import Runner


class StepFacts(Protocol):
    """A step as shown."""

    @property
    def stage(self) -> int:
        """Index of its stage."""

    @property
    def file(self) -> str:
        """The required file it stands in; empty: the source itself."""

    @property
    def line(self) -> int:
        """Line of that text, from 1, or by its own number."""

    @property
    def text(self) -> str:
        """Its statement."""

    @property
    def word(self) -> str:
        """The word that its statement begins with."""

    @property
    def macro(self) -> str:
        """The macro whose call it comes from; empty: none."""

    @property
    def needs(self) -> Device | None:
        """The device that it works, if there is one besides the arm."""

    @property
    def ways(self) -> tuple[int | None, ...]:
        """The steps that may follow; None: the end."""

    @property
    def place(self) -> str:
        """Its line, as messages give it: `12`, or `pins.al:12`."""

    @property
    def examines(self) -> str | None:
        """Name of the picture that it looks at, if it looks at one."""

    @property
    def guarded(self) -> bool:
        """It moves until something is felt."""

    @property
    def begins_search(self) -> bool:
        """It sets up a search."""


class ExecutedStep(Protocol):
    """A step that was executed and that the arm has not undone."""

    @property
    def step(self) -> int:
        """Its number."""

    @property
    def enters(self) -> bool:
        """Its stage began with it."""


class Listing(Protocol):
    """Stages and steps of a system's program, and the source they were made from."""

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def source(self) -> str:
        """Its text."""

    @property
    def required(self) -> dict[str, str]:
        """Texts of the files that it requires."""

    @property
    def numbered(self) -> Mapping[int, str]:
        """The lines of the text by numbers that it gives them itself; empty: they are counted from 1."""

    @property
    def stages(self) -> tuple[str, ...]:
        """Names of the stages."""

    @property
    def labels(self) -> Mapping[str, Sequence[int]]:
        """The steps that each label stands before."""

    @property
    def steps(self) -> Sequence[StepFacts]:
        """The steps; they are numbered by their place."""

    @property
    def errors(self) -> Collection[int]:
        """Numbers of the errors that steps may raise; none where steps raise none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settable:
    """Something that a person can set in a paused run."""

    noun: str
    usage: str  # form of the words after its kind: `NAME x y z`
    names: tuple[str, ...]
    units: tuple[float, ...]  # SI units in one of the displayed units number in
    fewest: int  # numbers that have to be given; the others stay as they are
    present: Callable[[str], tuple[float, ...]]  # the values of a name as they are, SI


class RunningSystem(Protocol):
    """A machine that can be stepped, kept and put back."""

    @property
    @abstractmethod
    def state(self) -> SystemState:
        """All that it remembers: the record it lives in."""

    @property
    def cell(self) -> SnapshotCell | None:
        """The simulated cell it acts on, if there is one."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the arm's joints, in order; none of a system without one."""
        return ()

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Channels recorded in its servo periods, besides joints and hand."""
        return ()

    @property
    @abstractmethod
    def time(self) -> float:
        """Its clock, s: 0 as the program begins."""

    @property
    def trouble(self) -> str | None:
        """Why it cannot do any step, if it is not a matter for the operator."""

    @property
    def switched_on(self) -> float:
        """Its clock when this object began to simulate, s: below 0 by the time in which it prepared its first step; 0
        if what an earlier run had kept spared it that."""
        return 0.0

    @property
    def unkept(self) -> str | None:
        """The reason why its preparation could not be kept for other runs."""
        return None

    @abstractmethod
    def begin(self) -> Sequence[AnyEvent]:
        """Prepare the first step; the events that begin the run, `RunStarted` first, at 0. Raises Halted."""

    @abstractmethod
    def step(self) -> None:
        """Do one step, the unit that is done again when it is interrupted. Raises Halted or PhysicsFailed."""

    def answer(self, choice: Choice) -> None:
        """Continue after the operator was called."""

    @property
    def executed(self) -> Sequence[ExecutedStep]:
        """Steps that were executed and that the arm has not undone, in order; none of a system that cannot undo."""
        return ()

    def reverse(self, undoing: ReversalOrder) -> None:
        """From now on each step undoes one that was executed, the last first; raises InvalidInput without any."""

    @abstractmethod
    def finish(self) -> bool:
        """Emit `RunFinished`; True if the program ended."""

    @property
    def context(self) -> ExecutionContext | None:
        """Context in which a plan of motions is executed; None if the system executes none."""
        return None

    @property
    def arm_cell(self) -> SimulatedCell | None:
        """The cell in which a plan of motions is executed."""
        return None

    @property
    def shots(self) -> Mapping[str, Shot]:
        """Pictures that its program took and still has, by name."""
        return {}

    def marks(self, picture: str) -> Sequence[Mark]:
        """Marks of what was found in a picture."""
        return ()

    @property
    def just_found(self) -> tuple[str, Sequence[Mark]]:
        """The picture in which the step under way has found something, and the marks of that alone."""
        return "", ()

    def built(self) -> Findings:
        """The referee's findings on finished work since undone; empty if there was none or it was not judged."""
        return {}

    def remembered(self) -> Findings:
        """Findings on the program's memory after everything it did is undone."""
        return {}

    @abstractmethod
    def restore(self, state: SystemState) -> None:
        """Continue from a copy of a state, with its cell as at that time; raises InvalidInput if it does not fit the
        plan.
        """

    @property
    def shown(self) -> Mapping[str, Any]:
        """Its state, for display."""
        shown: dict[str, Any] = msgspec.to_builtins(self.state, enc_hook=np.ndarray.tolist)
        return shown

    def type_line(self, text: str, task: str) -> None:
        """Give a task a line typed at the console, and emit `LineTyped` before all that comes of it. Raises
        InvalidInput if this system has no console, or no such task; nothing has happened then."""
        raise Refused("this system has no console to type at")

    def settables(self) -> Mapping[str, Settable]:
        """Things that a person can set, by kind; by default none."""
        return {}

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        """Set something; SI; raises InvalidInput if there is no such object, or the value does not fit it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunCallbacks:
    """Callbacks that a system is given by the run that drives it."""

    emit: Callable[[AnyEvent], None]
    watch: Callable[[ServoPeriod], None]  # called for every servo period
    halt: Callable[[], bool]  # the panic button, asked at every servo period
    viewed: Callable[[int, int], None] = lambda *_: None  # calibration views: number, count
    vision: Stopwatch = field(default_factory=Stopwatch)  # processor time of vision
    parts: Parts = OWN
    calibrate: bool = False  # calibrate again, whatever is kept


@dataclass(frozen=True, slots=True, kw_only=True)
class StepperWords:
    """The words of the stepper's manual for the runs of a system."""

    about: tuple[str, ...] = (
        "The program runs one step at a time; the arrow marks the next one.",
    )  # lines on what a step is
    places: tuple[str, ...] = (
        "PLACE is a line, a label, the first word of a step, or a stage. WHAT is one of",
    )  # lines on what can be said for PLACE and WHAT; the topics follow
    units: str = "those of the system"
    commands: Mapping[str, str] = field(default_factory=dict)  # help by usage
    without: tuple[str, ...] = ("picture",)  # names of commands that do nothing


Topics = Mapping[str, tuple[str, Callable[["Runner"], Any]]]  # by topic: field of the answer, view
PLAIN: Final[Topics] = {
    "time": ("time_s", lambda runner: runner.time),
    "state": ("state", lambda runner: runner.system.shown),
}  # topics of any system


class System(ABC):
    """A system: how its plans are written and read, its state, how it is built, and its words."""

    name: str  # its entry's
    plan: type[Record]
    state: type[SystemState]
    words: StepperWords = StepperWords()

    @property
    def entry(self) -> Entry:
        return entry_named(self.name)

    @abstractmethod
    def encode(self, plan: Any) -> bytes:
        """A plan as bytes."""

    @abstractmethod
    def decode(self, data: bytes, name: str) -> Any:
        """The plan in some bytes, found valid; `name` is for messages. Raises InvalidInput."""

    def digest(self, plan: Any, data: bytes) -> str:
        """Sixteen hexadecimal digits that identify a plan, `data` as bytes."""
        return written_digest(data)

    def alike(self, one: Any, other: Any) -> bool:
        """True if two plans are the same, except for the last digits of computed numbers."""
        return self.encode(one) == self.encode(other)

    @abstractmethod
    def listing(self, plan: Any) -> Listing:
        """Stages and steps of a plan."""

    @abstractmethod
    def build(self, setup: Setup, around: RunCallbacks) -> RunningSystem:
        """A run's machine, before its first step; raises InvalidInput if it cannot be built here."""

    def machine(self, plan: Any) -> tuple[str, str]:
        """Name and digest of the machine that a plan is for; empty if it is for none."""
        return "", ""

    def check(self, setup: Setup) -> None:
        """Raises InvalidInput unless plan, task and world of a run go together."""
        if not isinstance(setup.plan, self.plan):
            raise BadFile(f"this is not a plan of {self.entry.title}")

    def own_plan(self, task: str) -> Any:
        """The system's default plan for a task; raises InvalidInput if there is none."""
        raise refusal(self.name, "plans")

    def executed(self, plan: Any, state: Any) -> Sequence[ExecutedStep]:
        """Steps of a plan that were executed and not undone, by a state."""
        return ()

    def order(self, plan: Any, state: Any, undoing: ReversalOrder) -> None:
        """Set a state to undo executed steps; raises InvalidInput if there is nothing to undo."""
        raise refusal(self.name, "undo")

    def calibration(self, state: Any) -> Calibration | None:
        """The calibration of the camera in a state, if it has one."""
        return None

    # -- what users see -------------------------------------------------------------------------------

    @property
    def topics(self) -> Topics:
        """The topics of a paused run that can be shown."""
        return PLAIN

    def choices(self, runner: Runner) -> Mapping[Choice, str]:
        """The answers to the call of the operator that a run stands at, and what each does."""
        return {
            "proceed": "proceed: continue after the step that called the operator",
            "retry": "retry what was to be done",
            "skip": "skip it",
        }

    # -- the way of a run -----------------------------------------------------------------------------

    def carry_out(self, runner: Runner, go: Callable[[], Pause]) -> Pause:
        """Continue a run from its present state; `go` lets it run until it pauses."""
        return go()

    def files(self, runner: Runner, pause: Pause, result: Any) -> Mapping[str, bytes]:
        """Files that a run adds to its folder, by names in its entry; `result` is its `results.result.Result`."""
        return {}

    def page(self, folder: Path) -> bytes | None:
        """The report of the finished run in a folder that has those files; None: it is made as for every run."""
        return None
