"""The plan of a MAL run: the text of the program, and the settings of the run."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, ClassVar, Final, Literal

import msgspec

from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.core.source import LARGEST
from handeye.program.operation import Device
from handeye.systems.sigma.mal.compiler import MalProgram, program_of
from handeye.systems.sigma.mal.virtual_machine import STATEMENT_US
from handeye.systems.sigma.mal.words import MAL_DEVICES

ArmName = Literal["none", "wired", "gantries"]
JobName = Literal["chess", "handover", "insert", "line", "prco"]
TaskName = Literal["mal", "gantries", JobName]
MOST_PIECES: Final = 12
LONGEST_STATEMENT_US: Final = 1_000_000


class MalPlan(Record, frozen=True, kw_only=True):
    """A program, and the machine on which it runs."""

    name: str
    text: Annotated[str, msgspec.Meta(max_length=LARGEST)]
    arm: ArmName = "none"
    """The machine: perfect motors (`none`); the firmware of all microcomputers on the wires of the bus; or that
    firmware with simulated gantries.
    """
    statement_us: Annotated[int, msgspec.Meta(ge=0, le=LONGEST_STATEMENT_US)] = STATEMENT_US

    pieces: Annotated[int, msgspec.Meta(ge=0, le=MOST_PIECES)] = 0  # on the board, with gantries
    job: JobName = "chess"  # whose pieces they are

    @property
    def task(self) -> TaskName:
        """Name of the task to which runs of the plan belong."""
        if self.pieces:
            return self.job
        return "gantries" if self.arm == "gantries" else "mal"

    @property
    def program(self) -> MalProgram:
        """The compiled program. Raises BadFile if the text has errors."""
        return program_of(self.name, self.text, line=self.task == "line")


@dataclass(frozen=True, slots=True, kw_only=True)
class MalStep:
    """A line of a listing."""

    line: int  # its own number
    text: str
    word: str
    task: str
    ways: tuple[int | None, ...]
    stage: ClassVar[int] = 0
    file: ClassVar[str] = ""
    macro: ClassVar[str] = ""
    examines: ClassVar[None] = None
    guarded: ClassVar[bool] = False
    begins_search: ClassVar[bool] = False

    @property
    def needs(self) -> Device | None:
        """The device that the line uses: `hand` if the line actuates a device of a hand, or else None."""
        return (
            "hand"
            if self.word == "ACTUATE" and any(f" {name}" in self.text for name in MAL_DEVICES)
            else None
        )

    @property
    def place(self) -> str:
        return str(self.line)


@dataclass(frozen=True, slots=True, kw_only=True)
class MalListing:
    """The executable lines of a program, in the order of their numbers."""

    name: str
    source: str
    steps: Sequence[MalStep]
    labels: Mapping[str, Sequence[int]]
    stages: tuple[str, ...]
    numbered: Mapping[int, str]
    required: ClassVar[dict[str, str]] = {}
    errors: ClassVar[tuple[int, ...]] = ()


@lru_cache(maxsize=8)
def listing(plan: MalPlan) -> MalListing:
    """Return the listing of a plan. Its labels are the names of the tasks."""
    program = plan.program
    steps = [
        MalStep(line=line.number, text=line.text, word=line.word, task=line.task, ways=line.ways)
        for line in program.lines
    ]
    labels: dict[str, Sequence[int]] = {}
    for number, line in enumerate(program.lines):
        labels.setdefault(line.task, (number,))
    return MalListing(
        name=plan.name, source=plan.text, steps=tuple(steps), labels=labels, stages=(plan.name,),
        numbered=program.texts,
    )  # fmt: skip


def encode(plan: MalPlan) -> bytes:
    return msgspec.json.format(msgspec.json.encode(plan), indent=1) + b"\n"


def decode(data: bytes, name: str) -> MalPlan:
    """Decode a plan; raises BadFile."""
    try:
        plan = msgspec.json.decode(data, type=MalPlan)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{name} is not a valid plan: {error}") from None
    sound(plan)
    return plan


def sound(plan: MalPlan) -> None:
    """Raise BadFile unless the plan's program can be executed."""
    if plan.pieces and plan.arm != "gantries":
        raise BadFile(f"{plan.name} has pieces on its board, but no gantries")
    if not plan.program.lines:
        raise BadFile(f"{plan.name} has no line that can be executed")
