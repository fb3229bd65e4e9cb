"""Benches by name: machines that no task's program drives, opened where somebody asks for one, and jobs on them."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Literal

import msgspec

from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.systems.trig.language.tabletop import Tabletop

if TYPE_CHECKING:
    from handeye.cell.bench import Bench
    from handeye.cell.photograph import Photograph
    from handeye.cell.snapshot_cell import SnapshotCell
    from handeye.judge.finding import Findings
    from handeye.ports.axes import Axes
    from handeye.systems.trig.language.axes_arm import AxesArm
    from handeye.systems.trig.language.session import Session
    from handeye.systems.trig.language.teachable import Halted, TrigArm
    from handeye.tasks.interface import AnyTask

ArmName = Literal["none", "purbrick"]
JobName = Literal["palletise", "bucket"]
MOST_BLOCKS = 20
"""Of the palletiser's stack: the arm reaches over no more."""
_LONGEST = 100_000
"""Characters of a script: those of the paper have a thousand."""


class SeenTable(Tabletop):
    """What lies before an arm, and can be looked at."""

    @abstractmethod
    def photograph(self, width: int, height: int) -> "Photograph":
        """Arm and table as somebody sees them who stands before them; the program never does.

        Raises:
            InvalidInput: no OpenGL on this machine.
        """


def open_bench(name: Literal["purbrick"]) -> "tuple[TrigArm, SeenTable]":
    """An arm for TRIG that is switched on, and what lies before it, in the world without errors."""
    from handeye.systems.trig.jobs.bench import purbrick  # with its physics: only where it is asked for

    return {"purbrick": purbrick}[name]()


class Lying(Record, frozen=True, kw_only=True):
    """How a block truly lies, by its middle over the platter."""

    name: str
    at: tuple[float, float, float]
    """mm"""
    turned: float
    """deg about the vertical."""


def new_session(arm: ArmName) -> "Session":
    """A session of TRIG in which nothing was done, at an arm that is imagined or at one with physics."""
    from handeye.systems.trig.language.no_arm import NoArm
    from handeye.systems.trig.language.script import Script
    from handeye.systems.trig.language.session import Session

    if arm == "none":
        imagined = NoArm()
        return Session(arm=imagined, table=imagined, desk=Script(()))
    built, table = open_bench(arm)
    return Session(arm=built, table=table, desk=Script(()))


Moment = Literal["taught", "turned", "now"]
"""A moment of a job: it had just been taught, or was about to be undone, or the present."""


class TaughtPlan(Record, frozen=True, kw_only=True):
    """A job, and what is typed for it: each world teaches it a little otherwise."""

    job: JobName
    script: str

    @property
    def task(self) -> JobName:
        """Name of the task: that of the job."""
        return self.job


def read_taught_plan(data: bytes, name: str) -> TaughtPlan:
    """The plan in some bytes; its script has not been typed.

    Raises:
        InvalidInput: there is none.
    """
    try:
        plan = msgspec.json.decode(data, type=TaughtPlan)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{name} is not sound: {error}") from None
    if len(plan.script) > _LONGEST:
        raise BadFile(f"{name} is not sound: its script has more than {_LONGEST} characters")
    return plan


class TaughtJob(ABC):
    """A program of TRIG that is taught in a drawn world, carried out, and judged by a referee."""

    task: "AnyTask"
    session: "Session"
    """A new one; the desk is whoever's carries it out."""
    arm: "AxesArm"
    """That of the session."""
    axes: "Axes"
    """Its port."""
    undoable: bool
    """What it does can be undone."""

    @abstractmethod
    def teach(self, halted: "Halted") -> None:
        """Type the program, as the paper has it, with a teach box that is a little off, and lay the table for a run."""

    @abstractmethod
    def lay(self) -> None:
        """Lay the table as it is when the program has been taught, for a state that is put back."""

    @property
    @abstractmethod
    def bench(self) -> "Bench":
        """What it is carried out on."""

    @property
    @abstractmethod
    def cell(self) -> "SnapshotCell":
        """The same with the table laid for a run, to be kept, put back and judged."""

    @abstractmethod
    def lying(self, when: "Moment") -> tuple[Lying, ...]:
        """How the blocks lay at a moment, in the order in which they are taken, for a report."""

    @abstractmethod
    def turn(self) -> None:
        """Remember how everything stands, for the referee: from here on it is undone."""

    def built(self) -> "Findings":
        """Findings of the referee on the work as it stood where it was about to be undone; none if nothing was."""
        return {}

    @property
    def stack(self) -> int | None:
        """Blocks of the stack that is laid for a run; None: there is none."""
        return None

    @property
    @abstractmethod
    def goals(self) -> tuple[tuple[float, float], ...]:
        """Where the referee wants blocks laid by the program, mm, in the order in which they are taken."""

    def remembered(self) -> "Findings":
        """Whether the program is as it was taught, when it has been undone; by default nobody asks."""
        return {}


def job_script(name: JobName, blocks: int = MOST_BLOCKS) -> str:
    """What is typed for a job; `blocks` are those of the palletiser's stack."""
    from handeye.systems.trig.jobs.jobs import script_of

    return script_of(name, blocks)


def open_job(name: JobName, seed: int | None, script: str) -> TaughtJob:
    """A job in the world of a seed, or in the one without errors, in which nothing has been typed yet."""
    from handeye.systems.trig.jobs.jobs import BucketJob, PalletJob
    from handeye.systems.trig.jobs.world import BlocksWorld

    return {"palletise": PalletJob, "bucket": BucketJob}[name](script, BlocksWorld(seed))
