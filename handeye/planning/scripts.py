"""Compiles and plans scripts."""

from dataclasses import dataclass

from handeye.arm.model import ArmModel
from handeye.core.diagnostics import Diagnostic
from handeye.core.pose import Array
from handeye.core.source import Source
from handeye.planfile.plan import Plan
from handeye.planning.planner import make_plan
from handeye.program.language import Language
from handeye.program.program import Program
from handeye.program.taught import Taught


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedScript:
    """The plan of a text, and its diagnostics."""

    source: Source
    plan: Plan | None
    diagnostics: list[Diagnostic]


def plan_source(
    source: Source,
    taught: Taught,
    arm: ArmModel,
    language: Language,
    *,
    task: str,
    start: Array | None = None,
) -> PlannedScript:
    """Compile and plan a text; `task` and `start` are as for `make_plan`."""
    program, diagnostics = language.compile(source, taught)
    if program is None:
        return PlannedScript(source=source, plan=None, diagnostics=diagnostics)
    plan, problems = plan_program(program, arm, language, task=task, start=start)
    return PlannedScript(source=source, plan=plan, diagnostics=[*diagnostics, *problems])


def plan_program(
    program: Program, arm: ArmModel, language: Language, *, task: str = "", start: Array | None = None
) -> tuple[Plan | None, list[Diagnostic]]:
    """The plan of a program, with diagnostics in the words of its language; `task` is needed for the plan only."""
    plan, findings = make_plan(program, arm, task=task, start=start)
    return plan, language.phrase(program, arm, findings)
