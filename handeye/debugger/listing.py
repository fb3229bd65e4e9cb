"""Shows the program to users: its stages and steps, the source around a line, and the places that users name."""

import re
from bisect import bisect_left
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName
from handeye.core.plain_text import counted, one_line, printable
from handeye.core.record import Record
from handeye.core.source import Source, line_name
from handeye.debugger.view_records import TaskView
from handeye.runs.system import Listing

Place = tuple[str, int]  # a required file (empty for the script itself), and a line of that file
_PLACE: Final = re.compile(r"(?:(?P<file>[^:]+):)?(?P<line>[0-9]{1,9})")


class ListedStep(Record, frozen=True, kw_only=True, omit_defaults=True):
    """A step, which users select by its number in the plan."""

    step: int
    file: str = ""  # the required file that contains its line; empty for the script itself
    line: int
    text: str


class ListedStage(Record, frozen=True, kw_only=True, omit_defaults=True):
    """A stage, which users select by its number, counted from 1."""

    number: int
    name: str
    file: str = ""  # the required file in which it begins; empty for the script itself
    lines: tuple[int, int] | None
    """First and last line of the stage's steps in the file; None if there are no steps. Steps of macros count only if
    the stage has no other steps.
    """
    steps: tuple[ListedStep, ...]


class SourceLine(Record, frozen=True, kw_only=True, omit_defaults=True):
    """A line of the source, or of a required file."""

    file: str = ""
    line: int
    text: str
    here: bool  # the run is at this line
    tasks: tuple[str, ...] = ()  # tasks that are at this line, in a system with several tasks


def listing(program: Listing) -> tuple[ListedStage, ...]:
    """Return the stages of a plan with their steps."""
    listed: list[list[ListedStep]] = [[] for _ in program.stages]
    for number, step in enumerate(program.steps):
        shown = ListedStep(step=number, file=step.file, line=step.line, text=one_line(step.text))
        listed[step.stage].append(shown)
    own = {number for number, step in enumerate(program.steps) if not step.macro}
    return tuple(
        _stage(number, name, steps, own)
        for number, (name, steps) in enumerate(zip(program.stages, listed, strict=True), 1)
    )


def listing_text(program: Listing) -> list[str]:
    """Return the stages of a plan and their steps as lines of text."""
    found = listing(program)
    width = max(len(stage.name) for stage in found)
    out = []
    for stage in found:
        count = counted(len(stage.steps), "step")
        where = ""
        if stage.lines is not None:
            where = f"  lines {line_name(stage.lines[0], stage.file)} to {stage.lines[1]}"
        out.append(f"{stage.number:3}  {stage.name:{width}}  {count:>9}{where}".rstrip())
        places = [line_name(step.line, step.file) for step in stage.steps]
        column = max([4, *map(len, places)])
        out += [
            f"{step.step:10}  line {place:{column}}  {step.text}"
            for step, place in zip(stage.steps, places, strict=True)
        ]
    return out


def excerpt(
    program: Listing,
    line: int,
    here: int | None,
    around: int,
    file: str = "",
    tasks: Sequence[TaskView] = (),
) -> tuple[SourceLine, ...]:
    """Return the line with the number `line`, and N lines before and after it, where N is `around`. Two kinds of lines
    are marked: the line with the number `here`, and the present lines of the tasks.
    """
    standing: dict[int, list[str]] = {}
    for each in tasks:
        if each.file == file:
            standing.setdefault(each.line, []).append(each.task)
    lines = lines_of(program, file)
    numbers = [*lines]
    at = bisect_left(numbers, line)
    return tuple(
        SourceLine(
            file=file,
            line=number,
            text=printable(lines[number].expandtabs()),
            here=number == here,
            tasks=tuple(standing.get(number, ())),
        )
        for number in numbers[max(0, at - around) : at + around + 1]
    )


def excerpt_lines(lines: tuple[SourceLine, ...], mark: str = "→") -> list[str]:
    """Return an excerpt as lines of text. `mark` precedes the present line of the run; `·` precedes the present
    lines of other tasks.
    """
    width = len(str(lines[-1].line)) if lines else 0
    head = [f"    {printable(lines[0].file.expandtabs())}"] if lines and lines[0].file else []
    return head + [
        f"{mark if line.here else '·' if line.tasks else ' ':>3} {line.line:{width}}  {line.text}".rstrip()
        + (f"   [{', '.join(line.tasks)}]" if line.tasks else "")
        for line in lines
    ]


def numbered_stage(program: Listing, stage: int) -> str:
    """Return a stage with its number, such as `stage 4, insert the aligning pins`."""
    return f"stage {stage + 1}, {program.stages[stage]}"


def _stage(number: int, name: str, steps: list[ListedStep], own: set[int]) -> ListedStage:
    """Return a stage. `own` are the steps that do not come from a macro."""
    here = [step for step in steps if step.step in own] or steps
    file = here[0].file if here else ""
    lines = [step.line for step in here if step.file == file]
    extent = (min(lines), max(lines)) if lines else None
    return ListedStage(number=number, name=name, file=file, lines=extent, steps=tuple(steps))


def lines_of(program: Listing, file: str) -> Mapping[int, str]:
    """Return the lines of a required file or, if `file` is empty, of the script. The keys are the line numbers."""
    if program.numbered and not file:
        return program.numbered
    text = program.required[file] if file else program.source
    source = Source(name=program.name, text=text.removesuffix("\n"))
    return {number: source.line(number) for number in range(1, source.text.count("\n") + 2)}


def named_place(text: str, program: Listing) -> Place | None:
    """Return the place that `12` or `pins.al:12` names, or None if the text has another form. Raises InvalidInput if
    the program has no file with the name in the text.
    """
    given = _PLACE.fullmatch(text.strip())
    if given is None:
        return None
    file, line = given["file"] or "", int(given["line"])
    if not file or (file not in program.required and file in (program.name, f"{program.name}.al")):
        return "", line
    found = [key for key in program.required if key == file or key.endswith(f"/{file}")]
    if not found and Path(file).name == f"{program.name}.al":
        return "", line
    if not found:
        known = ", ".join(map(quoted, program.required)) or "none"
        raise NoSuchName(f"the script does not require a file {quoted(file)}; it requires: {known}")
    return (file if file in found else found[0]), line
