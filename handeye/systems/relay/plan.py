"""The plan of a relay: its legs, and the plans of the programs that do them."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, ClassVar, Final

import msgspec

from handeye.core.diagnostics import Diagnostic, has_errors, quoted
from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.core.source import LARGEST, Source, line_name
from handeye.program import numbered
from handeye.runs.legs import LegSystem, leg_system
from handeye.runs.system import Listing, StepFacts
from handeye.systems.relay.reading import LegLine, parsed

TASK: Final = "water_pump"
LARGEST_PLAN: Final = 1 << 26  # characters


class ProgramPlan(Record, frozen=True, kw_only=True):
    """A program that does one leg or several."""

    file: str
    system: str
    plan: Annotated[str, msgspec.Meta(max_length=LARGEST_PLAN)]  # as its system writes it


class LegPlan(Record, frozen=True, kw_only=True):
    """A leg: a stage of the task, and the file of the program that does this stage."""

    stage: str
    file: str
    line: int  # in the file of the relay


class RelayPlan(Record, frozen=True, kw_only=True):
    """A relay."""

    name: str
    text: Annotated[str, msgspec.Meta(max_length=LARGEST)]
    task: str = TASK
    programs: tuple[ProgramPlan, ...]
    legs: tuple[LegPlan, ...]

    def program(self, file: str) -> ProgramPlan:
        return next(program for program in self.programs if program.file == file)


@dataclass(frozen=True, slots=True, kw_only=True)
class Leg:
    """A leg with everything that is needed to run it."""

    index: int
    stage: str
    file: str
    system: LegSystem
    plan: Any  # of the program, as its own system decodes it
    first: int  # number of its first step in the listing of the relay
    steps: range  # in the listing of its program
    onward: int | None  # number of the first step of the next leg; None after the last leg

    @property
    def numbers(self) -> range:
        """Numbers of the leg's steps in the listing of the relay."""
        return range(self.first, self.first + len(self.steps))

    def number(self, step: int | None) -> int | None:
        """Return the number that a step of the program has in the relay. For a step outside the leg, return the first
        step of the next leg.
        """
        return self.first + step - self.steps[0] if step is not None and step in self.steps else self.onward


@dataclass(frozen=True, slots=True)
class RelayStep:
    """A step of a leg, numbered in the relay."""

    step: StepFacts
    stage: int
    file: str
    ways: tuple[int | None, ...]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self.step, name)

    @property
    def place(self) -> str:
        return line_name(self.step.line, self.file)


@dataclass(frozen=True, slots=True, kw_only=True)
class RelayListing:
    """The steps of all legs. Each leg is a stage."""

    name: str
    source: str
    stages: tuple[str, ...]
    steps: Sequence[Any]
    errors: frozenset[int]
    required: dict[str, str]
    numbered: ClassVar[dict[int, str]] = {}
    labels: ClassVar[dict[str, Sequence[int]]] = {}


def made(source: Source, folder: Path) -> RelayPlan:
    """Read the programs of a relay from their files in `folder`. Raises InvalidInput if the relay or a program has
    errors.
    """
    lines, found = parsed(source)
    if has_errors(found):
        row = source.position(found[0].primary.span.start)[0]
        raise BadFile(f"{source.name}, line {row}: {found[0].message}")
    files: dict[str, LegLine] = {}
    for line in lines:
        files.setdefault(line.file, line)
    programs = []
    for file, line in files.items():
        try:
            system = leg_system(line.system)
            plan = system.read(folder / file)
        except BadFile as error:
            raise BadFile(f"{source.name}, line {line.line}: {error}") from None
        written = system.encode(plan).decode()
        programs.append(ProgramPlan(file=file, system=line.system, plan=written))
    made = RelayPlan(
        name=Path(source.name).name,
        text=source.text,
        programs=tuple(programs),
        legs=tuple(LegPlan(stage=line.stage, file=line.file, line=line.line) for line in lines),
    )
    sound(made)
    return made


def decode(data: bytes, name: str) -> RelayPlan:
    """Decode a plan; raises BadFile."""
    return numbered.decode(data, name, RelayPlan, sound)


def sound(plan: RelayPlan) -> None:
    """Raise BadFile unless each leg has a program that does its stage."""
    files = [program.file for program in plan.programs]
    stages = [leg.stage for leg in plan.legs]
    if (
        not stages
        or len({*stages}) < len(stages)
        or len({*files}) < len(files)
        or {*files} != {leg.file for leg in plan.legs}
    ):
        raise BadFile(f"{plan.name} is not a valid relay: its legs and programs do not belong together")
    legs(plan)


def decoded(program: ProgramPlan) -> Any:
    """Return the plan of a program. Raises BadFile if the plan is not valid."""
    return _decoded(program.system, program.file, program.plan)


@lru_cache(maxsize=16)
def _decoded(system: str, file: str, plan: str) -> Any:
    return leg_system(system).decode(plan.encode(), file)


@lru_cache(maxsize=4)
def legs(plan: RelayPlan) -> tuple[Leg, ...]:
    """Return the legs of a plan. Raises InvalidInput if a program does not have the stage of its leg."""
    found: list[Leg] = []
    first = 0
    for index, each in enumerate(plan.legs):
        program = plan.program(each.file)
        system = leg_system(program.system)
        whole = decoded(program)
        try:
            steps = system.steps(whole, each.stage)
        except BadFile as error:
            raise BadFile(f"{plan.name}, line {each.line}: {error}") from None
        if not steps:
            raise BadFile(
                f"{plan.name}, line {each.line}: the stage {quoted(each.stage)} of {each.file} is empty"
            )
        last = index + 1 == len(plan.legs)
        found.append(
            Leg(
                index=index, stage=each.stage, file=each.file, system=system, plan=whole, first=first, steps=steps,
                onward=None if last else first + len(steps),
            )
        )  # fmt: skip
        first += len(steps)
    return tuple(found)


@lru_cache(maxsize=4)
def listing(plan: RelayPlan) -> RelayListing:
    """Return the listing of a plan."""
    steps: list[RelayStep] = []
    errors: set[int] = set()
    required = {}
    for leg in legs(plan):
        own: Listing = leg.system.listing(leg.plan)
        errors |= {*own.errors}
        required[leg.file] = own.source
        required |= {f"{leg.file}/{name}": text for name, text in own.required.items()}
        for number in leg.steps:
            step = own.steps[number]
            file = f"{leg.file}/{step.file}" if step.file else leg.file
            ways = tuple(leg.number(way) for way in step.ways)
            steps.append(RelayStep(step, leg.index, file, ways))
    return RelayListing(
        name=plan.name, source=plan.text, stages=tuple(leg.stage for leg in plan.legs), steps=steps,
        errors=frozenset(errors), required=required,
    )  # fmt: skip


def mistakes(source: Source) -> list[Diagnostic]:
    return parsed(source)[1]
