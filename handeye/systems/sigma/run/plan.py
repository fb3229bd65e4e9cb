"""The plan of a MAL run: the text of the program, and the settings of the run."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Annotated, Final, Literal

import msgspec

from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.core.source import LARGEST
from handeye.program import numbered
from handeye.program.numbered import NumberedListing, NumberedStep
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
    """The machine: perfect motors (`none`), the firmware of all microcomputers on the wires of the bus (`wired`), or
    this firmware with simulated gantries (`gantries`).
    """
    statement_us: Annotated[int, msgspec.Meta(ge=0, le=LONGEST_STATEMENT_US)] = STATEMENT_US

    pieces: Annotated[int, msgspec.Meta(ge=0, le=MOST_PIECES)] = 0  # pieces on the board of the gantries
    job: JobName = "chess"  # the job to which the pieces belong

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


@lru_cache(maxsize=8)
def listing(plan: MalPlan) -> NumberedListing:
    """Return the listing of a plan. The labels of the listing are the names of the tasks."""
    program = plan.program
    steps = [
        NumberedStep(
            line=line.number, text=line.text, word=line.word, ways=line.ways,
            needs="hand" if line.word == "ACTUATE" and any(f" {name}" in line.text for name in MAL_DEVICES) else None,
        )
        for line in program.lines
    ]  # fmt: skip
    labels: dict[str, Sequence[int]] = {}
    for number, line in enumerate(program.lines):
        labels.setdefault(line.task, (number,))
    return NumberedListing(
        name=plan.name, source=plan.text, steps=steps, labels=labels, numbered=program.texts
    )


def decode(data: bytes, name: str) -> MalPlan:
    """Decode a plan; raises BadFile."""
    return numbered.decode(data, name, MalPlan, sound)


def sound(plan: MalPlan) -> None:
    """Raise BadFile unless the plan's program can be executed."""
    if plan.pieces and plan.arm != "gantries":
        raise BadFile(f"{plan.name} has pieces on its board, so its arm must be `gantries`, not `{plan.arm}`")
    if not plan.program.lines:
        raise BadFile(f"{plan.name} has no line that can be executed")
