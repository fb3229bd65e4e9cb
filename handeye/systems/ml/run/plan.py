"""The plan of an ML run: the text of the program, and the settings of the run."""

from collections.abc import Mapping
from functools import lru_cache
from typing import Annotated, Literal

import msgspec

from handeye.core.errors import BadFile
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.source import LARGEST, Source
from handeye.program import numbered
from handeye.program.numbered import NumberedListing, NumberedStep
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
    """The statement at which the program of the left arm begins; None if there is no left arm."""
    stimuli: Annotated[tuple[Stimulus, ...], msgspec.Meta(max_length=MOST_STIMULI)] = ()  # for perfect motors
    outline: Annotated[tuple[Point, ...], msgspec.Meta(max_length=MOST_CORNERS)] = ()
    """The corners (y, x), in ML units, of an object that the wand touches. Only an arm with perfect motors has such an
    object.
    """
    job: str = ""  # the job that the program does; empty: none
    variant: str = ""  # variant of the job

    @property
    def lines(self) -> Mapping[int, Line]:
        """The stored statements. The keys are their numbers. Raises BadFile if the text has errors."""
        return stored(self.name, self.text, self.first, self.left)

    @property
    def task(self) -> str:
        """Name of the task to which runs of the plan belong."""
        return self.job or ("ml" if self.arm == "none" else self.arm)


@lru_cache(maxsize=8)
def stored(name: str, text: str, first: int | None, left: int | None) -> Mapping[int, Line]:
    """Return the lines of a program. The keys are the numbers of the lines. Raises BadFile if the text has errors."""
    lines, found = checked(Source(text=text, name=name), first=first, left=left)
    if errors := [each for each in found if each.severity == "error"]:
        raise BadFile(f"{name} has {counted(len(errors), 'mistake')}, the first: {errors[0].message}")
    return lines


@lru_cache(maxsize=8)
def listing(plan: MlPlan) -> NumberedListing:
    """Return the listing of a plan."""
    statements = {number: line.statement for number, line in plan.lines.items()}
    index = {number: step for step, number in enumerate(statements)}
    flow = Flow(statements)
    steps = [
        NumberedStep(
            line=number,
            text=str(statement),
            word=statement.code,
            ways=tuple(None if way is None else index[way] for way in flow.ways(number)),
            guarded=statement.code in MOTIONS,
            needs="hand" if statement.code in ("HAND", "DHAND") else None,
        )
        for number, statement in statements.items()
    ]
    texts = {number: str(statement) for number, statement in statements.items()}
    return NumberedListing(name=plan.name, source=plan.text, steps=steps, numbered=texts)


def decode(data: bytes, name: str) -> MlPlan:
    """Decode a plan; raises BadFile."""
    return numbered.decode(data, name, MlPlan, sound)


def sound(plan: MlPlan) -> None:
    """Raise BadFile unless the plan's program can be executed."""
    lines = plan.lines
    if not lines:
        raise BadFile(f"{plan.name} has no statement with a sequence number")
    for number in (plan.first, plan.left):
        if number is not None and number not in lines:
            raise BadFile(f"{plan.name} has no statement {number}")
    if plan.arm != "none" and (plan.stimuli or plan.outline):
        raise BadFile(f"{plan.name} has stimuli or an outline, which apply only to perfect motors")
    if plan.job and plan.left is not None:
        raise BadFile(f"{plan.name} has a program for the left arm, but no job has a left arm")
    channels = {source.channel for source in RIGHT.analog.values()}
    channels |= {name for names in (*RIGHT.digital.values(), RIGHT.interlocks) for name in names}
    for stimulus in plan.stimuli:
        if stimulus.channel not in channels:
            raise BadFile(f"{plan.name} has a stimulus for {stimulus.channel}, which the arm does not sense")
