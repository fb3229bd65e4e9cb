"""Commands that look into plans; nothing moves."""

from pathlib import Path
from typing import Annotated, Final, Literal

import msgspec
from cyclopts import Parameter

from handeye.cli.common import Json, PlanFile, put, put_json, say
from handeye.core.errors import BadArgument
from handeye.core.files import Kind, write_over

StageName = Annotated[str | None, Parameter(help="One stage only: its number, its name, or a piece of it.")]
DRAWINGS: Final = {"svg": Kind("SVG drawing", rb"<svg ", ending=".svg"), "dot": Kind("graph", rb"digraph ")}


def inspect(
    file: PlanFile,
    /,
    *,
    stage: StageName = None,
    graph: Annotated[Literal["svg", "dot"] | None, Parameter(help="Draw the flow instead.")] = None,
    output: Annotated[
        Path | None,
        Parameter(name=["--output", "-o"], help="File for the drawing; by default standard output."),
    ] = None,
    json: Json = False,
) -> int:
    """Show what a plan does: stages, steps, times, guards, forces, and what each step depends on."""
    from handeye.cli.programs import plan_at
    from handeye.debugger.breakpoints import stage_number
    from handeye.inspection.drawing import flow_svg
    from handeye.inspection.flow import flow, flow_dot
    from handeye.inspection.inspection import inspection, inspection_text

    if graph is not None and json:
        raise BadArgument("--graph and --json do not go together")
    plan = plan_at(file)
    number = None if stage is None else stage_number(stage, plan.program) + 1
    if graph is not None:
        shown = flow(plan, number)
        _write(flow_svg(shown) if graph == "svg" else flow_dot(shown), output, DRAWINGS[graph])
    elif output is not None:
        raise BadArgument("--output needs --graph svg or --graph dot")
    elif json:
        found = inspection(plan)
        kept = tuple(s for s in found.stages if number in (None, s.number))
        put_json(msgspec.structs.replace(found, stages=kept))
    else:
        for line in inspection_text(inspection(plan), number):
            say(line)
    return 0


def diff(old: PlanFile, new: PlanFile, /, *, json: Json = False) -> int:
    """Compare what two plans do, step by step.

    Exit code 0: both do the same; 1: they do not; 2: bad input.
    """
    from handeye.cli.programs import plan_at
    from handeye.inspection.difference import difference
    from handeye.inspection.difference_text import difference_text

    found = difference(plan_at(old), plan_at(new))
    if json:
        put_json(found)
    else:
        for line in difference_text(found):
            say(line)
    return 0 if found.same else 1


def schema(
    *,
    output: Annotated[
        Path | None,
        Parameter(name=["--output", "-o"], help="File for the schema; by default standard output."),
    ] = None,
) -> int:
    """Print the JSON schema of the plan format."""
    from handeye.planfile.schema import SCHEMA, plan_schema

    _write(plan_schema(), output, SCHEMA)
    return 0


def _write(text: str, output: Path | None, kind: Kind) -> None:
    if output is None:
        put(text.encode())
    else:
        write_over(output, text.encode(), kind)
