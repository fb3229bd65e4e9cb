"""Markdown files as tests. A program stands in a block `al`; what it comes to, in blocks behind it:

toml        before it: what is taught, for the rest of the file; else `handeye.editor.explain.SAMPLE`
al          the program; `al strict`: as `handeye check --strict-1973` reads it
diagnostic  what `handeye check` says of it; there is none if nothing is said
plan        what `handeye inspect` says of its plan
cell        the cell it is carried out in, see `cells.py`; else an empty one
run         what `handeye trace show` would tell of that
"""

import re
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from cells import ARM, cell_of

from handeye import al
from handeye.al import AL
from handeye.arm.ik import solve
from handeye.cell.compiled_arm import CompiledArm
from handeye.core.diagnostics import Diagnostic, arranged, render
from handeye.core.source import Source
from handeye.editor.samples import SAMPLE
from handeye.execution.context import ExecutionContext
from handeye.execution.executor import Executor
from handeye.inspection.inspection import inspection, inspection_text
from handeye.planfile.plan import Plan
from handeye.planning.planner import plan_program
from handeye.program.events import AnyEvent
from handeye.program.program import Program
from handeye.program.taught import Taught, load_taught
from handeye.program.world_model import WorldModel
from handeye.tasks.water_pump.world.nominal import DRAWING
from handeye.trace.account import account

ROOT = Path(__file__).parents[2]
MANUAL = ROOT / "docs" / "language"
WALKED = MANUAL / "tutorial.md"  # by tests/test_tutorial.py, from a shell
SUITES = [*sorted({*MANUAL.rglob("*.md")} - {WALKED}), *sorted(Path(__file__).parent.glob("*.md"))]
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SHOWN = ("diagnostic", "plan", "run")


@dataclass(slots=True, kw_only=True)
class Case:
    """A program of a file, and the blocks that belong to it: text by kind."""

    name: str
    program: str
    strict: bool = False
    taught: str | None = None
    required: dict[str, str] = field(default_factory=dict)
    blocks: dict[str, str] = field(default_factory=dict)
    spans: dict[str, tuple[int, int]] = field(default_factory=dict)


def cases(file: Path) -> list[Case]:
    """The programs of a file."""
    found: list[Case] = []
    text, taught = file.read_text(encoding="utf-8"), None
    required: dict[str, str] = {}
    for match in BLOCK.finditer(text):
        kind, word, content = match.groups()
        if kind == "toml":
            taught = content
        elif kind == "al" and word not in (None, "strict"):
            required[word] = content
        elif kind == "al":
            name, strict = f"{file.stem}-{len(found) + 1}", word is not None
            found.append(Case(name=name, program=content, strict=strict, taught=taught, required=required))
            required = {}
        elif kind in (*SHOWN, "cell"):
            assert found, f"{file.name}: {kind} without a program before it"
            assert kind not in found[-1].blocks, f"{found[-1].name}: two of {kind}"
            found[-1].blocks[kind], found[-1].spans[kind] = content, match.span(3)
    return found


def shown(case: Case) -> dict[str, str]:
    """What really comes of a program: of each kind that is shown, and any diagnostic."""
    program, found = compiled(case)
    plan = None
    if program is not None:
        plan, problems = plan_program(program, ARM, AL)
        found = [*found, *problems]
    if case.strict:
        found = arranged([*found, *al.extensions(_source(case))])
    out = {"diagnostic": _rendered(found, _source(case))} if found else {}
    if plan is not None and "plan" in case.blocks:
        out["plan"] = "\n".join(inspection_text(inspection(plan))) + "\n"
    if plan is not None and "run" in case.blocks:
        out["run"] = "\n".join(account(carried_out(plan, case.blocks.get("cell", "")))).strip("\n") + "\n"
    return out


def compiled(case: Case) -> tuple[Program | None, list[Diagnostic]]:
    """The checked program of a case, and what there is to say of it."""
    return al.compile_text(_source(case), taught(case.taught))


def carried_out(plan: Plan, cell: str) -> list[AnyEvent]:
    """What happens in a cell that is given in words."""
    world = WorldModel.of(plan.program)
    middle = (ARM.lower + ARM.upper) / 2
    begun = [np.array(motion.knots[0]) for motion in plan.motions.values()][:1]
    at_rest = solve(ARM, world.planned_position("PARK"), middle).q if not begun else begun[0]
    assert at_rest is not None
    events: list[AnyEvent] = []
    run = ExecutionContext(
        plan=plan,
        arm=ARM,
        cell=cell_of(cell, at_rest),
        camera=DRAWING,
        emit=events.append,
        arithmetic=CompiledArm,
    )
    executor = Executor(run=run)
    while executor.state.at is not None:
        executor.step()
    executor.finish()
    return events


def _source(case: Case) -> Source:
    return al.sewn_of(Source(name="example.al", text=case.program), case.required)


def taught(toml: str | None) -> Taught:
    """What a block of TOML teaches; the sample if there is none."""
    if toml is None:
        return SAMPLE
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "example.toml"
        file.write_text(toml, encoding="utf-8")
        return load_taught(file)


def _rendered(found: list[Diagnostic], source: Source) -> str:
    return "\n\n".join(render(diagnostic, source) for diagnostic in found) + "\n"
