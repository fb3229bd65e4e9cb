"""The program to look at: its stages and steps, its labels, and the source around a line."""

from typing import Final

from handeye.al.definition import Role
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.macros import expand
from handeye.al.parser import parse
from handeye.al.syntax import Statement
from handeye.plan.plan import Plan
from handeye.plan.program import Program, Record
from handeye.source import Source

_NO_STEP: Final = (Role.MODIFIER, Role.SHIFT, Role.DECLARATION)
"""What a statement can be that makes no step of its own."""


class ListedStep(Record, frozen=True, kw_only=True):
    """A step, by its number in the plan."""

    step: int
    line: int
    text: str


class ListedStage(Record, frozen=True, kw_only=True):
    """A stage, by its number from 1."""

    number: int
    name: str
    lines: tuple[int, int] | None
    """First and last line of its steps, those of macros only if it has no others; None if it has no steps."""
    steps: tuple[ListedStep, ...]


class SourceLine(Record, frozen=True, kw_only=True):
    """A line of the source."""

    line: int
    text: str
    here: bool
    """The run stands at it."""


def listing(plan: Plan) -> tuple[ListedStage, ...]:
    """The stages of a plan with their steps."""
    program = plan.program
    listed: list[list[ListedStep]] = [[] for _ in program.stages]
    for number, step in enumerate(program.steps):
        listed[step.stage].append(ListedStep(step=number, line=step.line, text=one_line(step.text)))
    macros = _macro_lines(program)
    return tuple(
        ListedStage(number=number, name=name, lines=_extent(steps, macros), steps=tuple(steps))
        for number, (name, steps) in enumerate(zip(program.stages, listed, strict=True), 1)
    )


def listing_text(plan: Plan) -> list[str]:
    """The stages of a plan and their steps as lines of text."""
    found = listing(plan)
    width = max(len(stage.name) for stage in found)
    out = []
    for stage in found:
        count = f"{len(stage.steps)} step{'' if len(stage.steps) == 1 else 's'}"
        where = "" if stage.lines is None else f"  lines {stage.lines[0]} to {stage.lines[1]}"
        out.append(f"{stage.number:3}  {stage.name:{width}}  {count:>9}{where}".rstrip())
        out += [f"{step.step:10}  line {step.line:<4}  {step.text}" for step in stage.steps]
    return out


def labels(program: Program) -> dict[str, list[int]]:
    """The steps that each label stands before; a label in a macro has one for each call."""
    found: dict[str, list[int]] = {}
    number = 0
    for placed in expand(parse(program.source)[0], lambda _: None):
        for label in placed.statement.labels:
            if number < len(program.steps):
                found.setdefault(label.text, []).append(number)
        number += _makes_step(placed.statement)
    return found


def excerpt(program: Program, line: int, here: int | None, around: int) -> tuple[SourceLine, ...]:
    """The source from `around` lines before `line` to as many after it; `here` is marked."""
    text = program.source.removesuffix("\n")
    source, last = Source(name=program.name, text=text), text.count("\n") + 1
    return tuple(
        SourceLine(line=number, text=_printable(source.line(number)), here=number == here)
        for number in range(max(1, line - around), min(last, line + around) + 1)
    )


def excerpt_lines(lines: tuple[SourceLine, ...], mark: str = "→") -> list[str]:
    """An excerpt as lines of text, `mark` before the line where the run stands."""
    width = len(str(lines[-1].line)) if lines else 0
    return [f"{mark if line.here else ' ':>3} {line.line:{width}}  {line.text}".rstrip() for line in lines]


def numbered_stage(program: Program, stage: int) -> str:
    """`stage 4, insert the aligning pins`."""
    return f"stage {stage + 1}, {program.stages[stage]}"


def one_line(text: str) -> str:
    """A statement without the blanks that put it in columns."""
    return _printable(" ".join(text.split()))


def _makes_step(statement: Statement) -> bool:
    if statement.word is None:
        return False
    definition = INSTRUCTIONS.get(statement.word.text)
    return definition is not None and definition.role not in _NO_STEP


def _macro_lines(program: Program) -> set[int]:
    macros = parse(program.source)[0].macros.values()
    return {statement.line for macro in macros for statement in macro.body}


def _extent(steps: list[ListedStep], macros: set[int]) -> tuple[int, int] | None:
    lines = [step.line for step in steps]
    own = [line for line in lines if line not in macros] or lines
    return (min(own), max(own)) if own else None


def _printable(text: str) -> str:
    """Text that changes nothing on a terminal but what it shows."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text.expandtabs())
