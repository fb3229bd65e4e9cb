"""Plans for Python programs: the steps and motions of a script, with a readable display."""

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Final

from handeye import tasks
from handeye.api.diagnostic import Diagnostic, ScriptError
from handeye.core.arguments import given_file, given_place
from handeye.core.brief import Several
from handeye.core.diagnostics import has_errors, quoted
from handeye.core.errors import BadArgument, BadFile
from handeye.core.files import read_whole
from handeye.core.notebook import bar, frame, heading, page, svg, table
from handeye.core.plain_text import counted
from handeye.core.source import Source
from handeye.inspection.drawing import flow_svg
from handeye.inspection.flow import flow
from handeye.inspection.inspection import InspectedStage, InspectedStep, Inspection, inspection
from handeye.planfile import plan as planfile
from handeye.planfile.store import alike, decode, plan_digest, write_plan
from handeye.program.stage_names import stage_index
from handeye.program.taught import Taught, load_taught, read_taught
from handeye.runs.scripts import plan_script, plan_text, program_named


@dataclass(frozen=True, kw_only=True)
class FlowDrawing:
    """A drawing of a plan: its steps, and arrows from each step to the steps that can follow it, normally or after an
    error. Notebooks show the drawing.
    """

    svg: str  # the drawing, as `handeye inspect --graph svg` writes it
    about: str  # caption of the drawing

    def __repr__(self) -> str:
        return f"<FlowDrawing {self.about}>"

    def _repr_html_(self) -> str:
        return page(svg(self.svg, self.about))


def flow_drawing(plan: planfile.Plan, stage: int | None = None) -> FlowDrawing:
    """Draw the flow of a whole plan, or of the stage with the given number (from 1)."""
    graph = flow(plan, stage)
    of = graph.name if stage is None else f"{graph.name}, {graph.stages[stage - 1]}"
    return FlowDrawing(svg=flow_svg(graph), about=f"flow of {of}: {counted(len(graph.nodes), 'step')}")


def plan_page(found: Inspection, diagnostics: Sequence[Diagnostic], flow: FlowDrawing | None) -> str:
    """Write the HTML for notebooks: the stages of a plan with their times, the warnings about its script, and its
    flow.
    """
    longest = max((stage.seconds for stage in found.stages), default=0.0) or 1.0
    steps = sum(len(stage.steps) for stage in found.stages)
    said = (
        f"{found.name}: {counted(len(found.stages), 'stage')}, {counted(steps, 'step')}, "
        f"{counted(found.motions, 'motion')} of the {found.arm} arm, {found.seconds:.1f} s planned"
    )
    rows = [
        (each.number, each.name, len(each.steps), each.seconds, bar(each.seconds / longest))
        for each in found.stages
    ]
    shown = table(("", "stage", "steps", "motion, s", ""), rows)
    drawn = () if flow is None else (svg(flow.svg, flow.about),)
    return page(heading(said), shown, *(frame(str(each)) for each in diagnostics), *drawn)


DRAWN: Final = 30
"""Notebooks do not show the flow of a plan with more steps than this; use `flow(stage)` for a single stage."""
FileName = str | os.PathLike[str]


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A compiled script with the motions planned for one arm.

    Two plans are equal if their steps and motions agree, apart from rounding errors.

    A notebook shows the stages with their times, the warnings about the script and, for a short plan, a drawing of
    the flow.

    >>> plan = handeye.plan('STAGE "a hand"\\nOPEN 1\\nOPEN 2\\n')
    >>> plan
    <Plan script: 1 stage, 2 steps, 0 motions>
    >>> plan.stages[0].name, [step.text for step in plan.steps]
    ('a hand', ['OPEN 1', 'OPEN 2'])
    """

    record: planfile.Plan  # the contents of the plan file, in SI units
    diagnostics: tuple[Diagnostic, ...] = field(default=(), compare=False)
    """Warnings about the script; empty if the plan was read from a file."""

    @property
    def name(self) -> str:
        """Name of the program: the name of the script's file without its ending."""
        return self.record.program.name

    @property
    def stages(self) -> tuple[InspectedStage, ...]:
        """Stages of the plan, each with `number` (the first is 1), `name`, `seconds` of planned motion, and `steps`."""
        return Several(self._laid_open.stages)

    @property
    def steps(self) -> tuple[InspectedStep, ...]:
        """Steps of the plan in the order of the script, each with `step` (its number), `line`, `text`, `seconds`,
        `conditions` and `next`.
        """
        return Several(step for stage in self.stages for step in stage.steps)

    @property
    def seconds(self) -> float:
        """Total duration of the planned motions, in seconds. A step in a loop counts once. Finger motions and pictures
        are not included.
        """
        return self._laid_open.seconds

    @property
    def digest(self) -> str:
        """Sixteen hexadecimal digits that identify the plan in runs and traces. The digits are the same on every
        processor.

        The digits depend on the script, taught positions, arm, task and planner, but not on the computed motions.
        """
        return plan_digest(self.record)

    def save(self, path: FileName) -> Path:
        """Write the plan as a JSON file, which `handeye run` and `handeye.plan` can read.

        Returns:
            the file.

        Raises:
            InvalidInput: the file cannot be written, or it exists and is not a plan.
        """
        file = given_file(path, "the destination of a plan must be a file")
        write_plan(file, self.record)
        return file

    def flow(self, stage: str | int | None = None) -> FlowDrawing:
        """Draw the steps of the plan, and an arrow from each step to the next. Red arrows show where the program
        goes after an error.

        Args:
            stage: draw only this stage: its number (the first is 1), its name, or a unique part of its name.

        Raises:
            InvalidInput: the plan does not have this stage.

        >>> handeye.plan("OPEN 1\\nOPEN 2\\n").flow()
        <FlowDrawing flow of script: 2 steps>
        """
        if stage is None:
            return flow_drawing(self.record)
        return flow_drawing(self.record, stage_index(given_place(stage), self.record.program.stages) + 1)

    @cached_property
    def _laid_open(self) -> Inspection:
        return inspection(self.record)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Plan) and self.digest == other.digest and alike(self.record, other.record)

    def __hash__(self) -> int:
        return hash(self.digest)

    def __repr__(self) -> str:
        counts = {"stage": self.stages, "step": self.steps, "motion": self.record.motions}
        return f"<Plan {self.name}: {', '.join(counted(len(these), each) for each, these in counts.items())}>"

    def _repr_html_(self) -> str:
        small = 0 < len(self.steps) <= DRAWN
        return plan_page(self._laid_open, self.diagnostics, self.flow() if small else None)


Planned = Plan | planfile.Plan  # a plan, or its record


def plan(script: FileName | Planned, *, taught: FileName | None = None, task: str | None = None) -> Plan:
    """Compile a script and plan its motions. Nothing is simulated.

    Args:
        script: a file (`.al`) with its taught file (`.toml`) next to it; the name of an included program, if no
            file has that name; the text of a script, which is a `str` that contains a line end; or a saved plan
            (`.json`).
        taught: taught positions of the script, in inches and degrees: a TOML file, or the text of one. By default, a
            script given as text has no taught positions.
        task: name of the task, which determines the arm; by default the task of the plan or the included program,
            else the water pump.

    Raises:
        ScriptError: the script has errors; the exception's `diagnostics` list them.
        InvalidInput: a file cannot be read, or its contents cannot be used.

    >>> handeye.plan("MOVE P\\nOPEN 2\\n", taught="[positions]\\nP = { at = [25, 38, 6, 90, 90, 0] }\\n").seconds > 1
    True
    """
    if isinstance(script, Plan | planfile.Plan):
        _check_untaught(script, taught)
        return _for_task(script if isinstance(script, Plan) else Plan(record=script), task)
    work, known = None if task is None else tasks.task(task), None if taught is None else _taught(taught)
    if isinstance(script, str) and "\n" in script:
        made = plan_text(script, known or Taught(), work or tasks.task())
    else:
        file = given_file(script, "a script must be a file or a text")
        if file.suffix == ".json":
            _check_untaught(file, taught)
            return _for_task(Plan(record=decode(read_whole(file), str(file))), task)
        if isinstance(script, str) and not file.exists() and (program := program_named(script)) is not None:
            file, work = program[0], work or program[1]
        elif isinstance(script, str) and not file.exists():
            raise BadFile(
                f"{script}: there is no such file; a script given as text must contain a line break"
            )
        made = plan_script(file, known, work)
    found = tuple(Diagnostic.of(each, made.source) for each in made.diagnostics)
    if made.plan is None or has_errors(made.diagnostics):
        raise ScriptError(found)
    return Plan(record=made.plan, diagnostics=found)


def _for_task(made: Plan, task: str | None) -> Plan:
    """Return the plan. Raises InvalidInput if the plan was made for a task other than `task`."""
    if task not in (None, made.record.task):
        raise BadArgument(f"the plan is for the task {quoted(made.record.task)}, not for {quoted(str(task))}")
    return made


def _check_untaught(made: object, taught: object) -> None:
    """Raises InvalidInput if taught positions are given together with a finished plan."""
    if taught is not None:
        raise BadArgument(f"{made} is a plan, which already has its positions; omit `taught=...`")


def _taught(given: FileName) -> Taught:
    if isinstance(given, str) and "\n" in given:
        return read_taught(Source(name="taught.toml", text=given))
    return load_taught(given_file(given, "taught= must be a file or a text"))
