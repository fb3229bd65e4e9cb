"""The plan of an ML run: the text of the program, and the settings of the run."""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, ClassVar, Literal

import msgspec

from handeye.core.errors import BadFile
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.source import LARGEST, Source
from handeye.program.operation import Device
from handeye.systems.ml.language.check import checked
from handeye.systems.ml.language.commands import MOTIONS
from handeye.systems.ml.language.flow import Flow
from handeye.systems.ml.language.syntax import LAST, Line
from handeye.systems.ml.machine.rectilinear import RIGHT
from handeye.systems.ml.machine.surroundings import MOST_CORNERS, MOST_STIMULI, Point, Stimulus

ArmName = Literal["none", "rectilinear"]
Number = Annotated[int, msgspec.Meta(ge=1, le=LAST)]


class MlPlan(Record, frozen=True, kw_only=True):
    """A program, and the machine on which it runs."""

    name: str
    text: Annotated[str, msgspec.Meta(max_length=LARGEST)]
    arm: ArmName = "none"  # perfect motors (`none`), or the simulated rectilinear arm
    first: Number | None = (
        None  # the statement at which the program begins; None: the one with the lowest number
    )
    left: Number | None = None
    """The statement at which the program of the left arm begins; None: there is no left arm."""
    stimuli: Annotated[tuple[Stimulus, ...], msgspec.Meta(max_length=MOST_STIMULI)] = ()  # of perfect motors
    outline: Annotated[tuple[Point, ...], msgspec.Meta(max_length=MOST_CORNERS)] = ()
    """The corners (y, x) of the object that the wand of an arm with perfect motors touches, ML units."""
    job: str = ""  # that the program does; empty: none
    variant: str = ""  # of the job

    @property
    def lines(self) -> Mapping[int, Line]:
        """The stored statements by their numbers. Raises BadFile if the text has errors."""
        return stored(self.name, self.text, self.first, self.left)

    @property
    def task(self) -> str:
        """Name of the task to which runs of the plan belong."""
        return self.job or ("ml" if self.arm == "none" else self.arm)


@dataclass(frozen=True, slots=True, kw_only=True)
class MlStep:
    """A statement of a listing."""

    line: int  # its sequence number
    text: str
    word: str
    ways: tuple[int | None, ...]
    guarded: bool
    stage: ClassVar[int] = 0
    file: ClassVar[str] = ""
    macro: ClassVar[str] = ""
    examines: ClassVar[None] = None
    begins_search: ClassVar[bool] = False

    @property
    def needs(self) -> Device | None:
        return "hand" if self.word in ("HAND", "DHAND") else None

    @property
    def place(self) -> str:
        return str(self.line)


@dataclass(frozen=True, slots=True, kw_only=True)
class MlListing:
    """The stored statements of a program, in ascending order of their numbers."""

    name: str
    source: str
    steps: Sequence[MlStep]
    numbered: Mapping[int, str]
    stages: tuple[str, ...]
    labels: ClassVar[dict[str, Sequence[int]]] = {}
    required: ClassVar[dict[str, str]] = {}
    errors: ClassVar[tuple[int, ...]] = ()

    def step_of(self, number: int) -> int:
        """Return the step of a statement; of one that was stored during the run, the step before it."""
        return max(bisect_right(self.steps, number, key=lambda step: step.line) - 1, 0)


@lru_cache(maxsize=8)
def stored(name: str, text: str, first: int | None, left: int | None) -> Mapping[int, Line]:
    """Return the lines of a program by their numbers. Raises BadFile if the text has errors."""
    lines, found = checked(Source(text=text, name=name), first=first, left=left)
    if errors := [each for each in found if each.severity == "error"]:
        raise BadFile(f"{name} has {counted(len(errors), 'mistake')}, the first: {errors[0].message}")
    return lines


@lru_cache(maxsize=8)
def listing(plan: MlPlan) -> MlListing:
    """Return the listing of a plan."""
    statements = {number: line.statement for number, line in plan.lines.items()}
    index = {number: step for step, number in enumerate(statements)}
    flow = Flow(statements)
    steps = [
        MlStep(
            line=number,
            text=str(statement),
            word=statement.code,
            ways=tuple(None if way is None else index[way] for way in flow.ways(number)),
            guarded=statement.code in MOTIONS,
        )
        for number, statement in statements.items()
    ]
    texts = {number: str(statement) for number, statement in statements.items()}
    return MlListing(name=plan.name, source=plan.text, steps=steps, stages=(plan.name,), numbered=texts)


def encode(plan: MlPlan) -> bytes:
    return msgspec.json.format(msgspec.json.encode(plan), indent=1) + b"\n"


def decode(data: bytes, name: str) -> MlPlan:
    """Decode a plan; raises BadFile."""
    try:
        plan = msgspec.json.decode(data, type=MlPlan)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{name} is not a valid plan: {error}") from None
    sound(plan)
    return plan


def sound(plan: MlPlan) -> None:
    """Raise BadFile unless the plan's program can be executed."""
    lines = plan.lines
    if not lines:
        raise BadFile(f"{plan.name} has no statement with a sequence number")
    for number in (plan.first, plan.left):
        if number is not None and number not in lines:
            raise BadFile(f"{plan.name} has no statement {number}")
    if plan.arm != "none" and (plan.stimuli or plan.outline):
        raise BadFile(f"{plan.name} has stimuli or an outline, which only perfect motors sense")
    if plan.arm != "none" and plan.left is not None:
        raise BadFile(f"{plan.name} has a program for the left arm, which the rectilinear arm works without")
    channels = {source.channel for source in RIGHT.analog.values()}
    channels |= {name for names in (*RIGHT.digital.values(), RIGHT.interlocks) for name in names}
    for stimulus in plan.stimuli:
        if stimulus.channel not in channels:
            raise BadFile(f"{plan.name} has a stimulus of {stimulus.channel}, which the arm does not sense")
