"""System: a machine that a run drives. It can step, give its state as one record and take it back; facts tell of it.

The executor of programs (`systems/stanford/executor_run.py`) is the first.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import msgspec
import numpy as np

from handeye.cell.kept import KeptCell
from handeye.core.errors import Refused
from handeye.core.record import Record
from handeye.execution.servo_period import ServoPeriod
from handeye.execution.stopwatch import Stopwatch
from handeye.execution.undo.done import Undoing
from handeye.program.events import AnyEvent, Choice, SystemEvent
from handeye.program.operation import Device
from handeye.program.system_state import SystemState
from handeye.runs.parts import OWN, Parts
from handeye.runs.setup import Setup


class StepFacts(Protocol):
    """A step as people see it."""

    @property
    def stage(self) -> int:
        """Index of its stage."""

    @property
    def file(self) -> str:
        """The required file it stands in; empty: the source itself."""

    @property
    def line(self) -> int:
        """Line of that text, from 1."""

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
        """Its line, as people are told: `12`, or `pins.al:12`."""


class ExecutedStep(Protocol):
    """A step that was executed and that the arm has not undone."""

    @property
    def step(self) -> int:
        """Its number."""

    @property
    def enters(self) -> bool:
        """Its stage began with it."""


class Listing(Protocol):
    """Stages and steps of what a system carries out, and the source they were made from."""

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
    def stages(self) -> tuple[str, ...]:
        """Names of the stages."""

    @property
    def labels(self) -> Mapping[str, Sequence[int]]:
        """The steps that each label stands before."""

    @property
    def steps(self) -> Sequence[StepFacts]:
        """The steps; they are numbered by their place."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settable:
    """Something that a person can set in a paused run."""

    noun: str
    usage: str
    """Form of the words after its kind: `NAME x y z`."""
    names: tuple[str, ...]
    units: tuple[float, ...]
    """SI units in one of the units that people give each number in."""
    fewest: int
    """Numbers that have to be given; the others stay as they are."""
    present: Callable[[str], tuple[float, ...]]
    """The values of a name as they are, SI."""


class System(Protocol):
    """A machine that can be stepped, kept and put back."""

    @property
    def state(self) -> SystemState:
        """All that it remembers: the record it lives in."""

    @property
    def cell(self) -> KeptCell | None:
        """The simulated cell it acts on, if there is one."""

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the arm's joints, in order; none of a system without one."""
        return ()

    @property
    def time(self) -> float:
        """Its clock, s."""

    @property
    def trouble(self) -> str | None:
        """Why it cannot do any step, if it is not a matter for the operator."""

    @property
    def kept_until(self) -> float:
        """The clock to which what an earlier run had kept has brought it, s; 0: it let all time pass itself."""
        return 0.0

    @property
    def unkept(self) -> str | None:
        """Why what it has prepared could not be kept for other runs."""
        return None

    def begin(self) -> Sequence[AnyEvent]:
        """Prepare the first step; the events that begin the run, `RunStarted` first.

        Raises:
            Halted: the panic button was hit.
        """

    def step(self) -> None:
        """Do one step: the unit that is done again when it is interrupted.

        Raises:
            Halted: the panic button was hit.
            SimulationError: its cell broke down.
        """

    def answer(self, choice: Choice) -> None:
        """Go on after the operator was called."""

    @property
    def executed(self) -> Sequence[ExecutedStep]:
        """Steps that were executed and that the arm has not undone, in order; none of a system that cannot undo."""
        return ()

    def reverse(self, undoing: Undoing) -> None:
        """From now on each step undoes one that was executed, the last first.

        Raises:
            InvalidInput: so much was not executed, or this system cannot undo anything.
        """
        raise Refused("this system cannot undo what it did")

    def finish(self) -> bool:
        """Close the account of the run; True when the program came to its end."""

    def restore(self, state: SystemState) -> None:
        """Go on from a copy of a state; its cell is as it was then.

        Raises:
            InvalidInput: it is not a state of what is carried out.
        """

    @property
    def shown(self) -> Mapping[str, Any]:
        """Its state, for people who look at it."""
        shown: dict[str, Any] = msgspec.to_builtins(self.state, enc_hook=np.ndarray.tolist)
        return shown

    def type_line(self, text: str, task: str) -> None:
        """Give a task a line typed at the console, and emit `LineTyped` before all that comes of it.

        Raises:
            InvalidInput: this system has no console, or no such task; nothing has happened then.
        """
        raise Refused("this system has no console to type at")

    def settables(self) -> Mapping[str, Settable]:
        """Things that a person can set, by kind."""

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        """Set something; SI.

        Raises:
            InvalidInput: there is no such thing, or the value does not fit it.
        """


@dataclass(frozen=True, slots=True, kw_only=True)
class Surroundings:
    """Callbacks that a system is given by the run that drives it."""

    emit: Callable[[AnyEvent], None]
    watch: Callable[[ServoPeriod], None]
    """Told of every servo period."""
    halt: Callable[[], bool]
    """The panic button, asked at every servo period."""
    viewed: Callable[[int, int], None] = lambda *_: None
    """Told of each view in which the camera is calibrated: its number, of how many."""
    vision: Stopwatch = field(default_factory=Stopwatch)
    """Processor time of vision."""
    parts: Parts = OWN
    calibrate: bool = False
    """Calibrate anew, whatever is kept."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SystemKind:
    """A kind of system: how its plans are written and read, what its state is, how it is built."""

    name: str
    """Checkpoints and traces name it."""
    plan: type[Record]
    state: type[SystemState]
    encode: Callable[[Any], bytes]
    """A plan as bytes; their digest stands for it."""
    decode: Callable[[bytes, str], Any]
    """The plan in some bytes, found sound; the name is for messages. Raises InvalidInput."""
    listing: Callable[[Any], Listing]
    machine: Callable[[Any], tuple[str, str]]
    """Name and digest of the machine that a plan is for; empty if it is for none."""
    check: Callable[[Setup], None]
    """Raises InvalidInput unless that machine is that of the task."""
    build: Callable[[Setup, Surroundings], System]
    """Raises InvalidInput if it cannot be built here."""
    events: tuple[type[SystemEvent], ...] = ()
    """Kinds of events that it adds to those of all systems."""
    executed: Callable[[Any, Any], Sequence[ExecutedStep]] = lambda plan, state: ()
    """Steps of a plan that were executed and not undone, by a state: what its `System.executed` would say."""
    order: Callable[[Any, Any, Undoing], None] = lambda plan, state, undoing: None
    """Let a state be one in which the arm undoes what it did; raises InvalidInput if there is nothing to undo."""
