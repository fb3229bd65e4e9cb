"""Defines the interface of a system that can run a leg of a relay.

A relay is a list of legs. Each leg does one stage of a task, in the language of one system. All legs share one cell.
The relay (`handeye/systems/relay`) finds the other systems by their entries: `Entry.leg` names a `LegSystem`.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from handeye.core.entries import entry_named, loaded, require
from handeye.core.record import Record
from handeye.program.system_state import SystemState
from handeye.runs.hand_over import HandOver, Kind, StationMemory
from handeye.runs.setup import Setup
from handeye.runs.system import ExecutedStep, Listing, RunCallbacks, RunningSystem
from handeye.runs.systems import system_named

if TYPE_CHECKING:
    from handeye.cell.simulated import SimulatedCell


class Use(NamedTuple):
    """A named value that a leg reads or writes, and the first line that reads or writes it."""

    name: str
    kind: Kind
    line: int


class Lack(NamedTuple):
    """A need that no leg can meet, such as a motor, and the program line that causes the need."""

    line: int
    sentence: str


class RunningLeg(RunningSystem):
    """A running program that executes one or more legs of a relay. Between two of these legs, the program keeps its
    memory, and other programs may move the arm.
    """

    @abstractmethod
    def stand_at(self, stage: str) -> None:
        """Go to the first step of a stage, unless the program is already in this stage."""

    @abstractmethod
    def take_over(self, stage: str, record: HandOver, station: StationMemory) -> None:
        """Take the arm over from another program to execute a stage. If the record lacks a value that the stage needs,
        or has this value in the wrong kind, the method changes nothing and raises Refused.
        """

    @abstractmethod
    def leave(self, record: HandOver | None) -> HandOver:
        """Set the brakes, and return the record for the next leg. The new record also contains those values of
        `record` that the program of this leg does not know.
        """

    def take_back(self, station: StationMemory) -> None:
        """Take the arm back from the program of the next leg, after that program has undone its steps. The arm is
        roughly where it was when this leg ended. The program of this leg needs this method only if it can undo its own
        steps.
        """
        raise NotImplementedError

    @property
    @abstractmethod
    def station(self) -> StationMemory:
        """The present memory of the station: its measurements of its own devices, and the state of its camera."""


class LegSystem(ABC):
    """A system that can run legs of a relay."""

    system: str  # its entry's name
    state: type[SystemState]  # of its running legs
    undoes = False  # True: its legs can be undone
    stages_in_text = False  # True: the text itself is divided into stages; False: it is one leg
    words: frozenset[str] | None = None
    """Operations (`program/operations.py`) for which the language has words; None if the language has words for all
    operations. In this set, `Restore` means that the language can use saved differences in a motion, and `Comply`
    means that it can control the force in a motion.
    """

    @abstractmethod
    def read(self, file: Path) -> Record:
        """Read a program and make its plan. Raises InvalidInput if the program has errors."""

    def encode(self, plan: Record) -> bytes:
        """Encode a plan as bytes. By default, the plan of a leg has the format of the system's other plans."""
        return system_named(self.system).encode(plan)

    def decode(self, data: bytes, name: str) -> Record:
        """Decode and check a plan. Messages call the plan `name`. Raises InvalidInput if the plan is not valid."""
        plan: Record = system_named(self.system).decode(data, name)
        return plan

    def digest(self, plan: Record, data: bytes) -> str:
        """Return sixteen hexadecimal digits that identify a plan. `data` is the encoded plan."""
        return system_named(self.system).digest(plan, data)

    def alike(self, one: Record, other: Record) -> bool:
        """Return True if two plans agree, apart from the last digits of computed numbers."""
        return system_named(self.system).alike(one, other)

    def listing(self, plan: Record) -> Listing:
        return system_named(self.system).listing(plan)

    def executed(self, plan: Record, state: SystemState) -> Sequence[ExecutedStep]:
        """Return the steps of a plan that, in a given state, have been executed and not undone."""
        return system_named(self.system).executed(plan, state)

    @abstractmethod
    def steps(self, plan: Record, stage: str) -> range:
        """Return the steps of a stage in the listing of a plan. Raises NoSuchName if the plan has no such stage."""

    def reads(self, plan: Record, stage: str) -> Sequence[Use]:
        """Return the values that a stage needs from the record or from an earlier stage of the same program."""
        return ()

    def writes(self, plan: Record, stage: str) -> Sequence[Use]:
        """Return the values that a stage adds to the record."""
        return ()

    def lacks(self, plan: Record, stage: str, earlier: Sequence[str]) -> Sequence[Lack]:
        """Return a stage's needs that no leg can meet. `earlier` gives the stages that earlier legs of the
        same program execute.
        """
        return ()

    def takes_pictures(self, plan: Record) -> bool:
        """Return True if a program takes pictures."""
        return False

    @abstractmethod
    def build(self, setup: Setup, around: RunCallbacks, cell: "SimulatedCell") -> RunningLeg:
        """Build the running system that executes a program. Other programs use the same cell, too."""


def leg_system(name: str) -> LegSystem:
    """Return the `LegSystem` of the system called `name`. Raises Refused if the system cannot run legs, and NoSuchName
    if there is no such system.
    """
    require(name, "leg")
    found: LegSystem = loaded(entry_named(name).leg)
    return found
