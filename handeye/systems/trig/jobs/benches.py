"""Finds benches and jobs by name. The physics is loaded only when a bench or job is opened."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Literal

import msgspec

from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.systems.trig.language.desk import Tabletop

if TYPE_CHECKING:
    from handeye.cell.bench import Bench
    from handeye.cell.photograph import Photograph
    from handeye.cell.snapshot_cell import SnapshotCell
    from handeye.core.variation import WorldSpec
    from handeye.judge.finding import Findings
    from handeye.ports.axes import Axes
    from handeye.systems.trig.language.axes_arm import AxesArm
    from handeye.systems.trig.language.session import Session
    from handeye.systems.trig.language.trig_arm import Halted, TrigArm
    from handeye.tasks.interface import AnyTask

ArmName = Literal["none", "purbrick"]
JobName = Literal["palletise", "bucket", "arrange"]
JOBS: tuple[JobName, ...] = ("palletise", "bucket", "arrange")
MOST_BLOCKS = 20  # blocks in the palletiser's stack, limited by the arm's reach
_LONGEST = 100_000  # characters of a script; the paper's scripts have about a thousand


class SeenTable(Tabletop):
    """A table that can be photographed."""

    @abstractmethod
    def photograph(self, width: int, height: int) -> "Photograph":
        """Return a photograph of the arm and the table. The program never sees this photograph."""


def open_bench(name: Literal["purbrick"]) -> "tuple[TrigArm, SeenTable]":
    """Return a TRIG arm that is switched on, and its table, in a world without errors."""
    from handeye.systems.trig.jobs.table import purbrick  # imports the physics, so only when it is needed

    return {"purbrick": purbrick}[name]()


class BlockPose(Record, frozen=True, kw_only=True):
    """The true pose of a block's centre, relative to the platter."""

    name: str
    at: tuple[float, float, float]  # mm
    turned: float  # deg about the vertical


def new_session(arm: ArmName) -> "Session":
    """Return a new TRIG session with the imaginary or the simulated arm."""
    from handeye.systems.trig.language.command_input import Script
    from handeye.systems.trig.language.no_arm import NoArm
    from handeye.systems.trig.language.session import Session

    if arm == "none":
        imagined = NoArm()
        return Session(arm=imagined, table=imagined, desk=Script(()))
    built, table = open_bench(arm)
    return Session(arm=built, table=table, desk=Script(()))


Moment = Literal["taught", "turned", "now"]  # just taught, about to be reversed, or now


class TaughtPlan(Record, frozen=True, kw_only=True):
    """A job with its script. In each world, the script is taught with different errors."""

    job: JobName
    script: str

    @property
    def task(self) -> JobName:
        """Name of the task. The task has the same name as the job."""
        return self.job


def read_taught_plan(data: bytes, name: str) -> TaughtPlan:
    """Decode a plan, without executing its script. Raises BadFile if the data are not a plan, or if the script is too
    long.
    """
    try:
        plan = msgspec.json.decode(data, type=TaughtPlan)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{name} is not valid: {error}") from None
    if len(plan.script) > _LONGEST:
        raise BadFile(f"{name} is not valid: its script has more than {_LONGEST} characters")
    return plan


class TaughtJob(ABC):
    """A TRIG program that is taught in a world, executed, and judged by a referee."""

    task: "AnyTask"
    session: "Session"  # new, without a desk
    arm: "AxesArm"  # the session's
    axes: "Axes"  # the arm's port
    undoable: bool  # can be reversed

    @abstractmethod
    def teach(self, halted: "Halted") -> None:
        """Enter the program, and prepare the table. The positions in the program contain the teaching errors of this
        world.
        """

    @abstractmethod
    def lay(self) -> None:
        """Put the table into the state that it has after teaching. To resume a saved run, call this method before you
        restore the saved state.
        """

    @property
    @abstractmethod
    def bench(self) -> "Bench":
        """The bench of the job."""

    @property
    @abstractmethod
    def cell(self) -> "SnapshotCell":
        """The bench as a cell whose state can be captured, restored and judged."""

    @abstractmethod
    def lying(self, when: "Moment") -> tuple[BlockPose, ...]:
        """Return the poses of the blocks at a given moment, in the order in which the arm picks them up."""

    @abstractmethod
    def turn(self) -> None:
        """Record the scene for the referee before the reversal."""

    def built(self) -> "Findings":
        """Return the referee's findings on the work before its reversal. If there was no reversal, there are no
        findings.
        """
        return {}

    @property
    def stack(self) -> int | None:
        """Number of blocks in the stack, or None if there is no stack."""
        return None

    @property
    @abstractmethod
    def goals(self) -> tuple[tuple[float, float], ...]:
        """The goals of the blocks (mm), in the order in which the arm picks the blocks up."""

    def remembered(self) -> "Findings":
        """Return the findings on the program after the arm has undone the program's work. By default, there are no
        findings.
        """
        return {}


def job_script(name: JobName, blocks: int = MOST_BLOCKS) -> str:
    """Return the script of a job. `blocks` is the number of blocks in the palletiser's stack."""
    from handeye.systems.trig.jobs.jobs import script_of

    return script_of(name, blocks)


def open_job(name: JobName, world: "WorldSpec | None", script: str) -> TaughtJob:
    """Open a job in a world. If `world` is None, the bench has no errors. Nothing is taught yet."""
    from handeye.systems.trig.jobs.jobs import ArrangeJob, BucketJob, PalletJob
    from handeye.systems.trig.jobs.world import BlocksWorld

    jobs: dict[JobName, type[PalletJob] | type[BucketJob] | type[ArrangeJob]] = {
        "palletise": PalletJob,
        "bucket": BucketJob,
        "arrange": ArrangeJob,
    }
    return jobs[name](script, BlocksWorld(world))
