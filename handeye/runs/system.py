"""`System`, the interface of a system in `handeye/systems`; and `RunningSystem`, the interface of a system during a
run: it can be stepped, saved and restored.

A system is found by its entry (`handeye/core/entries.py`), and is loaded when a run needs it.
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
    """A step as it is shown to users."""

    @property
    def stage(self) -> int:
        """Index of the step's stage."""

    @property
    def file(self) -> str:
        """The required file that contains the step; empty: the main text."""

    @property
    def line(self) -> int:
        """Line of the step in that text, from 1, or by the numbering of the text."""

    @property
    def text(self) -> str:
        """Statement of the step."""

    @property
    def word(self) -> str:
        """First word of the statement."""

    @property
    def macro(self) -> str:
        """The macro from whose call the step comes; empty: none."""

    @property
    def needs(self) -> Device | None:
        """The device besides the arm that the step uses; None: none."""

    @property
    def ways(self) -> tuple[int | None, ...]:
        """Steps that may follow; None: the end."""

    @property
    def place(self) -> str:
        """The line of the step as messages write it: `12`, or `pins.al:12`."""

    @property
    def examines(self) -> str | None:
        """Name of the picture that the step examines; None: none."""

    @property
    def guarded(self) -> bool:
        """True if the step's motion is ended by guards."""

    @property
    def begins_search(self) -> bool:
        """True if the step starts a search."""


class ExecutedStep(Protocol):
    """A step that was executed and has not been undone by the arm."""

    @property
    def step(self) -> int:
        """Number of the step."""

    @property
    def enters(self) -> bool:
        """True if the step began its stage."""


class Listing(Protocol):
    """Stages and steps of a system's program, and the source from which they were made."""

    @property
    def name(self) -> str:
        """Name of the program."""

    @property
    def source(self) -> str:
        """Source text of the program."""

    @property
    def required(self) -> dict[str, str]:
        """Texts of the files that the program requires."""

    @property
    def numbered(self) -> Mapping[int, str]:
        """Lines of the text by the text's own numbering; empty: lines are counted from 1."""

    @property
    def stages(self) -> tuple[str, ...]:
        """Names of the stages."""

    @property
    def labels(self) -> Mapping[str, Sequence[int]]:
        """Numbers of the steps at each label."""

    @property
    def steps(self) -> Sequence[StepFacts]:
        """The steps; the number of a step is its index."""

    @property
    def errors(self) -> Collection[int]:
        """Numbers of the errors that steps may raise; empty if steps raise none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settable:
    """A value that a person can set in a paused run."""

    noun: str
    usage: str  # form of the words after its kind: `NAME x y z`
    names: tuple[str, ...]
    units: tuple[float, ...]  # SI units in one of the displayed units number in
    fewest: int  # numbers that have to be given; the others stay as they are
    present: Callable[[str], tuple[float, ...]]  # the values of a name as they are, SI


class RunningSystem(Protocol):
    """A system during a run, which can be stepped, saved and restored."""

    @property
    @abstractmethod
    def state(self) -> SystemState:
        """The whole state of the system, as the record in which it lives."""

    @property
    def cell(self) -> SnapshotCell | None:
        """The simulated cell, if the system has one."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the arm's joints, in order; empty without an arm."""
        return ()

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Channels that are recorded in each servo period, besides joints and hand."""
        return ()

    @property
    @abstractmethod
    def time(self) -> float:
        """The clock of the system, s; 0 when the program begins."""

    @property
    def trouble(self) -> str | None:
        """The reason why no step is possible, if the operator cannot resolve it."""

    @property
    def switched_on(self) -> float:
        """The clock when this object began to simulate, s: negative by the duration of its preparation, or 0 if the
        preparation was kept from an earlier run.
        """
        return 0.0

    @property
    def unkept(self) -> str | None:
        """The reason why the preparation could not be kept for later runs; None if it was kept."""
        return None

    @abstractmethod
    def begin(self) -> Sequence[AnyEvent]:
        """Prepare the first step; returns the events that begin the run at time 0, `RunStarted` first. Raises
        Halted.
        """

    @abstractmethod
    def step(self) -> None:
        """Execute one step, which is the unit that is repeated after an interruption. Raises Halted or
        PhysicsFailed.
        """

    def answer(self, choice: Choice) -> None:
        """Continue after a call of the operator."""

    @property
    def executed(self) -> Sequence[ExecutedStep]:
        """Executed steps that the arm has not undone, in order; empty for a system that cannot undo."""
        return ()

    def reverse(self, undoing: ReversalOrder) -> None:
        """From now on, let each step undo an executed step, the last first; raises InvalidInput if there is none."""

    @abstractmethod
    def finish(self) -> bool:
        """Emit `RunFinished`; True if the program ended."""

    @property
    def context(self) -> ExecutionContext | None:
        """The context in which a plan of motions is executed; None if the system executes no such plans."""
        return None

    @property
    def arm_cell(self) -> SimulatedCell | None:
        """The cell in which a plan of motions is executed; None if the system executes no such plans."""
        return None

    @property
    def shots(self) -> Mapping[str, Shot]:
        """Pictures that the program took and still has, by name."""
        return {}

    def marks(self, picture: str) -> Sequence[Mark]:
        """Marks for the findings in a picture."""
        return ()

    @property
    def just_found(self) -> tuple[str, Sequence[Mark]]:
        """The picture in which the present step has found something, with the marks for that finding only."""
        return "", ()

    def built(self) -> Findings:
        """The referee's findings on finished work that was undone afterwards; empty if there was none, or it was
        not judged.
        """
        return {}

    @property
    def figures(self) -> Mapping[str, float]:
        """Figures of the run that its result shows besides the common ones; none by default."""
        return {}

    def remembered(self) -> Findings:
        """Findings on the program's memory after all its work was undone."""
        return {}

    @abstractmethod
    def restore(self, state: SystemState) -> None:
        """Continue from a copy of a state, with the cell as at that time; raises InvalidInput if the state does not
        fit the plan.
        """

    @property
    def shown(self) -> Mapping[str, Any]:
        """The state of the system, for display."""
        shown: dict[str, Any] = msgspec.to_builtins(self.state, enc_hook=np.ndarray.tolist)
        return shown

    def type_line(self, text: str, task: str) -> None:
        """Give a task a line that was typed at the console, and emit `LineTyped` before all its effects. Raises
        InvalidInput, without any effect, if the system has no console or no such task.
        """
        raise Refused("this system has no console to type at")

    def settables(self) -> Mapping[str, Settable]:
        """Values that a person can set, by kind; none by default."""
        return {}

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        """Set a value, SI; raises InvalidInput if there is no object with that name, or the value does not fit."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunCallbacks:
    """Callbacks that a run gives to its system."""

    emit: Callable[[AnyEvent], None]
    watch: Callable[[ServoPeriod], None]  # called for every servo period
    halt: Callable[[], bool]  # the panic button, asked at every servo period
    viewed: Callable[[int, int], None] = lambda *_: None  # calibration views: number, count
    vision: Stopwatch = field(default_factory=Stopwatch)  # processor time of vision
    parts: Parts = OWN
    calibrate: bool = False  # calibrate again, whatever is kept


@dataclass(frozen=True, slots=True, kw_only=True)
class StepperWords:
    """The words of the stepper's manual for runs of a system."""

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
    """A system: reads and writes its plans, builds its running system, and provides its words."""

    name: str  # its entry's
    plan: type[Record]
    state: type[SystemState]
    words: StepperWords = StepperWords()

    @property
    def entry(self) -> Entry:
        return entry_named(self.name)

    @abstractmethod
    def encode(self, plan: Any) -> bytes:
        """Encode a plan as bytes."""

    @abstractmethod
    def decode(self, data: bytes, name: str) -> Any:
        """Decode and check a plan; `name` is the plan's name for messages. Raises InvalidInput."""

    def digest(self, plan: Any, data: bytes) -> str:
        """Sixteen hexadecimal digits that identify a plan; `data` is the plan as bytes."""
        return written_digest(data)

    def alike(self, one: Any, other: Any) -> bool:
        """True if two plans agree, apart from the last digits of computed numbers."""
        return self.encode(one) == self.encode(other)

    @abstractmethod
    def listing(self, plan: Any) -> Listing:
        """Stages and steps of a plan."""

    @abstractmethod
    def build(self, setup: Setup, around: RunCallbacks) -> RunningSystem:
        """Build the running system before its first step; raises InvalidInput if it cannot be built here."""

    def machine(self, plan: Any) -> tuple[str, str]:
        """Name and digest of the machine that a plan is made for; empty if it is made for none."""
        return "", ""

    def check(self, setup: Setup) -> None:
        """Raises InvalidInput unless plan, task and world of a run fit together."""
        if not isinstance(setup.plan, self.plan):
            raise BadFile(f"this is not a plan of {self.entry.title}")

    def own_plan(self, task: str) -> Any:
        """The default plan for a task; raises InvalidInput if there is none."""
        raise refusal(self.name, "plans")

    def executed(self, plan: Any, state: Any) -> Sequence[ExecutedStep]:
        """Steps of a plan that were executed and not undone, according to a state."""
        return ()

    def order(self, plan: Any, state: Any, undoing: ReversalOrder) -> None:
        """Set a state to undo executed steps; raises InvalidInput if there are none."""
        raise refusal(self.name, "undo")

    def calibration(self, state: Any) -> Calibration | None:
        """The calibration of the camera in a state, if it has one."""
        return None

    # -- what users see -------------------------------------------------------------------------------

    @property
    def topics(self) -> Topics:
        """The topics that a paused run can show."""
        return PLAIN

    def choices(self, runner: Runner) -> Mapping[Choice, str]:
        """The possible answers to the present call of the operator, with their effects."""
        return {
            "proceed": "proceed: continue after the step that called the operator",
            "retry": "retry what was to be done",
            "skip": "skip it",
        }

    # -- the way of a run -----------------------------------------------------------------------------

    def carry_out(self, runner: Runner, go: Callable[[], Pause]) -> Pause:
        """Continue a run from its present state; `go` lets the run continue until it pauses."""
        return go()

    def files(self, runner: Runner, pause: Pause, result: Any) -> Mapping[str, bytes]:
        """Further files for the run's folder, by the names in the system's entry; `result` is the run's
        `results.result.Result`.
        """
        return {}

    def page(self, folder: Path) -> bytes | None:
        """The report of the finished run in a folder, made from the system's own files; None: the general report is
        used.
        """
        return None
