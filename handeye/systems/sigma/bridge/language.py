"""MAL as the planner needs it: as a language whose programs become plans."""

from collections.abc import Iterable
from functools import partial

from handeye.core.diagnostics import Diagnostic, arranged, problem
from handeye.core.source import Span, read_source
from handeye.program.diagnosis.plan_findings import NoConfiguration, PlanFinding
from handeye.program.diagnosis.reach import NamedArm, reach_sentence
from handeye.program.language import Language
from handeye.program.program import Program
from handeye.systems.sigma.bridge.translation import AT, LANGUAGE, translated

_SAID = {
    "hand-through-table": "the hand would go through the table",
    "hand-through-fixture": "the hand would go through a fixture",
    "carries-through-table": "the object in the hand would go through the table",
    "carries-through-fixture": "the object in the hand would go through a fixture",
    "stop-beyond-arm": "the arm cannot exert the force of this limit",
    "force-beyond-arm": "the arm cannot exert this force",
    "faint-force": "in free motion, joint friction alone can make the arm feel this force",
    "faint-moment": "in free motion, joint friction alone can make the arm feel this moment",
}


def bridge(at: tuple[float, float] = AT) -> Language:
    """Return the language of programs for a board whose corner is at `at` (mm) on the table."""
    return Language(name=LANGUAGE, read=read_source, compile=partial(translated, at=at), phrase=phrase)


def phrase(program: Program, arm: NamedArm, findings: Iterable[PlanFinding]) -> list[Diagnostic]:
    """Turn each finding of the planner into a diagnostic at the program line that the finding concerns."""
    return arranged(_phrased(program, arm, finding) for finding in findings)


def _phrased(program: Program, arm: NamedArm, finding: PlanFinding) -> Diagnostic:
    step = program.steps[finding.step]
    span: Span = program.whole.span("", step.line, step.span)
    number = step.text.split()[0]
    if isinstance(finding, NoConfiguration):
        told = f"the {arm.name} arm cannot make the motion of line {number}: {reach_sentence(arm, finding.reason)}"
    else:
        told = f"line {number}: {_SAID.get(finding.code, finding.code)}"
    return problem(finding.code, told, span)
