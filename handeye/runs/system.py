"""Defines the interfaces of a system in `handeye/systems`: `System`, and `RunningSystem`. A running system is a system
during a run; it can be stepped, saved and restored.

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
from handeye.core.markup import PagePart
from handeye.core.record import Record
from handeye.execution.context import ExecutionContext, Stopwatch
from handeye.execution.servo import ServoPeriod
from handeye.execution.state import ReversalOrder, Shot
from handeye.judge.finding import Findings
from handeye.planfile.store import written_digest
from handeye.ports.axes import Channel
from handeye.program.events import AnyEvent, Choice, LineTyped
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
    """A step of a program, as it is shown to users."""

    @property
    def stage(self) -> int:
        """Index of the step's stage."""

    @property
    def file(self) -> str:
        """Name of the file that contains the step, if the program requires this file; empty if the step is in the
        program's own text.
        """

    @property
    def line(self) -> int:
        """Line of the step in its file: counted from 1, or the number that the text itself gives to the line."""

    @property
    def text(self) -> str:
        """The statement from which the step was made."""

    @property
    def word(self) -> str:
        """First word of the statement."""

    @property
    def macro(self) -> str:
        """Name of the macro whose call produced the step; empty if no macro produced the step."""

    @property
    def needs(self) -> Device | None:
        """The device that the step uses in addition to the arm, or None."""

    @property
    def ways(self) -> tuple[int | None, ...]:
        """Numbers of the steps that may follow, with None for the end of the program."""

    @property
    def place(self) -> str:
        """The step's line as messages write it: `12`, or `pins.al:12`."""

    @property
    def examines(self) -> str | None:
        """Name of the picture that the step examines, or None."""

    @property
    def guarded(self) -> bool:
        """True if guards can end the step's motion."""

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
    """The stages and steps of a system's program, and the source text from which they were made."""

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
        """Lines of the text. Each key is the number that the text itself gives to the line. The mapping is empty if
        lines are counted from 1.
        """

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
        """Numbers of the errors that steps may raise; an empty collection if steps raise no errors."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settable:
    """A value that a person can change in a paused run."""

    noun: str
    usage: str  # form of the words after its kind: `NAME x y z`
    names: tuple[str, ...]
    units: tuple[float, ...]  # size of the displayed unit of each number, in SI units
    fewest: int  # how many numbers must be given; the others keep their values
    present: Callable[[str], tuple[float, ...]]  # the present values of a name, SI


class RunningSystem(Protocol):
    """A system during a run. A running system can be stepped, saved and restored."""

    @property
    @abstractmethod
    def state(self) -> SystemState:
        """The complete state of the system. The system changes its state in place."""

    @property
    def cell(self) -> SnapshotCell | None:
        """The simulated cell, or None if the system has none."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the arm's joints, in order; empty if there is no arm."""
        return ()

    @property
    def channels(self) -> tuple[Channel, ...]:
        """The channels that are recorded in each servo period. The joints and the hand are also recorded, but are not
        listed here.
        """
        return ()

    @property
    @abstractmethod
    def time(self) -> float:
        """The clock of the system (s), which is 0 when the program begins."""

    @property
    def trouble(self) -> str | None:
        """The reason why no step is possible even if the operator answers; None if a step is possible."""

    @property
    def switched_on(self) -> float:
        """The reading of the clock (s) when this object began to simulate. The clock reads 0 at the end of the
        preparation. This reading is therefore negative, or 0 if an earlier run stored the preparation.
        """
        return 0.0

    @property
    def unkept(self) -> str | None:
        """The reason why the preparation could not be stored for later runs; None if it was stored."""
        return None

    @abstractmethod
    def begin(self) -> Sequence[AnyEvent]:
        """Prepare the first step. Returns the events that begin the run at time 0, with `RunStarted` first. Raises
        Halted if the panic button is pressed.
        """

    @abstractmethod
    def step(self) -> None:
        """Execute one step. After an interruption, the whole step is repeated. Raises Halted if the panic button is
        pressed, or PhysicsFailed if the simulation breaks down.
        """

    def halt(self) -> None:
        """The run cannot continue: bring the machine to rest in a safe state, for example with its brakes on. A system
        that has no safe state does nothing.
        """
        return

    def answer(self, choice: Choice) -> None:
        """Continue after a call to the operator."""

    @property
    def executed(self) -> Sequence[ExecutedStep]:
        """The executed steps that the arm has not undone, in order. The sequence is empty for a system that cannot
        undo steps.
        """
        return ()

    def reverse(self, undoing: ReversalOrder) -> None:
        """From now on, each step undoes the last executed step that is not yet undone. Raises InvalidInput if no
        executed step is left."""

    @abstractmethod
    def finish(self) -> bool:
        """Emit `RunFinished`. Returns True if the program reached its end."""

    @property
    def context(self) -> ExecutionContext | None:
        """The context in which a plan of motions is executed; None if the system does not execute plans of motions."""
        return None

    @property
    def arm_cell(self) -> SimulatedCell | None:
        """The cell in which a plan of motions is executed; None if the system does not execute plans of motions."""
        return None

    @property
    def shots(self) -> Mapping[str, Shot]:
        """The pictures that the program took and still stores. The keys are their names."""
        return {}

    def marks(self, picture: str) -> Sequence[Mark]:
        """Return marks for everything that vision found in a picture."""
        return ()

    @property
    def just_found(self) -> tuple[str, Sequence[Mark]]:
        """The name of the picture that the present step searched, and a mark for each object that it found. The name
        is empty if the step found nothing.
        """
        return "", ()

    def built(self) -> Findings:
        """Return the findings that the referee made before the arm undid the finished work. The result is empty
        if the work was not undone, or was not judged.
        """
        return {}

    @property
    def legs(self) -> Sequence[tuple[str, str]]:
        """The system and the stage of each leg, in order, if the run is a relay; an empty sequence for other runs."""
        return ()

    @property
    def figures(self) -> Mapping[str, float]:
        """Figures that only this system adds to the result of the run. By default, a system adds no figures."""
        return {}

    def remembered(self) -> Findings:
        """Return findings on the program's memory after the arm has undone all its work."""
        return {}

    @abstractmethod
    def restore(self, state: SystemState) -> None:
        """Continue from a copy of a state. The caller must first restore the cell as it was when `state` was captured.
        Raises InvalidInput if the state does not fit the plan.
        """

    @property
    def shown(self) -> Mapping[str, Any]:
        """The state of the system, as users see it."""
        shown: dict[str, Any] = msgspec.to_builtins(self.state, enc_hook=np.ndarray.tolist)
        return shown

    def type_line(self, text: str, task: str) -> None:
        """Emit `LineTyped`, then pass a line typed at the console to a task. Raises InvalidInput, and changes nothing,
        if the system has no console, or no task with the name `task`.
        """
        raise Refused("this system has no console to type at")

    def interject(self, text: str, task: str) -> None:
        """Emit `LineTyped`, then execute a typed line in the middle of a step. If the line
        cannot be executed there, raises InvalidInput and changes nothing.
        """
        raise Refused("a line can be typed only while the run is paused; `pause` pauses it")

    def foresee(self, typed: Sequence[LineTyped]) -> None:
        """Execute the lines `typed` again in the middle of the next step, each at its time. Raises Refused if the
        system cannot execute lines in the middle of a step.
        """
        if typed:
            raise Refused("this system cannot execute a typed line in the middle of a step")

    @property
    def live(self) -> LiveNews | None:
        """The part of a live run's page that only this system shows; None if the system adds nothing to the page."""
        return None

    def settables(self) -> Mapping[str, Settable]:
        """Return the values that a person can set. The keys are the kinds of values. By default, a person can set no
        values.
        """
        return {}

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        """Set a value in SI units. `what` is the kind of the value, and `name` the object that has the value. Raises
        InvalidInput if no object has this name, or if the value does not fit the object.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class RunCallbacks:
    """Functions and settings that a run passes to its system."""

    emit: Callable[[AnyEvent], None]
    watch: Callable[[ServoPeriod], None]  # called for every servo period
    halt: Callable[[], bool]  # the panic button, polled in every servo period
    viewed: Callable[[int, int], None] = lambda *_: None  # calibration views: number, count
    vision: Stopwatch = field(default_factory=Stopwatch)  # processor time of vision
    parts: Parts = OWN
    calibrate: bool = False  # calibrate again, even if a calibration is stored


@dataclass(frozen=True, slots=True, kw_only=True)
class StepperWords:
    """The words with which the stepper's manual describes runs of a system."""

    about: tuple[str, ...] = (
        "The program runs one step at a time; the arrow marks the next step.",
    )  # lines that explain what a step is
    places: tuple[str, ...] = (
        "PLACE is a line, a label, the first word of a step, or a stage. WHAT is one of",
    )  # lines that say what PLACE and WHAT can be; the topics follow
    units: str = "those of the system"
    commands: Mapping[str, str] = field(default_factory=dict)  # help texts of further commands, by usage
    without: tuple[str, ...] = ("picture",)  # names of commands that have no effect in this system


class LiveNews(ABC):
    """The part of a live run's page that is specific to the run's system. While the run continues, the server's thread
    asks this object for news.
    """

    part: PagePart
    channels: Collection[str] = ()  # names of channels that the part shows

    @abstractmethod
    def since(self, seen: object) -> tuple[object, str] | None:
        """Return a mark that stands for the present moment, and a message with everything that is new. `seen` is the
        mark from the call before, or None at the first call. Returns None if nothing is new.
        """


Topics = Mapping[str, tuple[str, Callable[["Runner"], Any]]]  # by topic: field of the answer, view
PLAIN: Final[Topics] = {
    "time": ("time_s", lambda runner: runner.time),
    "state": ("state", lambda runner: runner.system.shown),
}  # topics of any system


class System(ABC):
    """A system: it reads and writes its plans, builds its running system, and provides its words for messages."""

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
        """Decode and check a plan. Messages call the plan `name`. Raises InvalidInput if the plan is not valid."""

    def digest(self, plan: Any, data: bytes) -> str:
        """Return sixteen hexadecimal digits that identify a plan. `data` is the encoded plan."""
        return written_digest(data)

    def alike(self, one: Any, other: Any) -> bool:
        """Return True if two plans agree, apart from the last digits of computed numbers."""
        return self.encode(one) == self.encode(other)

    @abstractmethod
    def listing(self, plan: Any) -> Listing:
        """Return the stages and steps of a plan."""

    @abstractmethod
    def build(self, setup: Setup, around: RunCallbacks) -> RunningSystem:
        """Build the running system, but do not execute a step. Raises InvalidInput if the system cannot be
        built on this computer.
        """

    def machine(self, plan: Any) -> tuple[str, str]:
        """Return the name and digest of the machine for which a plan is made; both are empty if the plan is made for
        no particular machine.
        """
        return "", ""

    def check(self, setup: Setup) -> None:
        """Raise InvalidInput unless plan, task and world of a run fit together."""
        if not isinstance(setup.plan, self.plan):
            raise BadFile(f"this is not a plan of {self.entry.title}")

    def own_plan(self, task: str) -> Any:
        """Return the default plan for a task. Raises InvalidInput if the task has no default plan."""
        raise refusal(self.name, "plans")

    def executed(self, plan: Any, state: Any) -> Sequence[ExecutedStep]:
        """Return the steps of a plan that, according to a state, were executed and have not been undone."""
        return ()

    def order(self, plan: Any, state: Any, undoing: ReversalOrder) -> None:
        """Change a state, so that a run that continues from it first undoes executed steps. `undoing` is the order to
        undo them. Raises InvalidInput if no executed step is left.
        """
        raise refusal(self.name, "undo")

    def calibration(self, state: Any) -> Calibration | None:
        """Return the camera calibration in a state, or None if the state has none."""
        return None

    # -- what users see -------------------------------------------------------------------------------

    @property
    def topics(self) -> Topics:
        """The topics that a paused run can show."""
        return PLAIN

    def choices(self, runner: Runner) -> Mapping[Choice, str]:
        """Return the possible answers to the present call to the operator, each with its effect."""
        return {
            "proceed": "proceed: continue after the step that called the operator",
            "retry": "retry: execute the step again",
            "skip": "skip: leave the step out",
        }

    # -- the course of a run -----------------------------------------------------------------------------

    def carry_out(self, runner: Runner, go: Callable[[], Pause]) -> Pause:
        """Continue a run from its present state. `go` continues the run until it pauses."""
        return go()

    def files(self, runner: Runner, pause: Pause, result: Any) -> Mapping[str, bytes]:
        """Return the contents of the files that this system adds to the run's folder. The keys are the names that the
        system's entry lists. `result` is the run's `results.result.Result`.
        """
        return {}

    def page(self, folder: Path) -> bytes | None:
        """Make the report of a finished run from the system's own files in the run's folder. Return None if the run
        uses the report that is common to all systems.
        """
        return None

    def parts(self, folder: Path) -> Sequence[PagePart]:
        """Return the sections that this system adds to the report of the run in `folder`."""
        return ()
