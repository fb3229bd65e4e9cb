"""Everything there is to say about a script, the arm's reach included."""

from handeye.arm.stanford import STANFORD
from handeye.diagnostics import Diagnostic
from handeye.plan.planner import make_plan
from handeye.plan.program import Program


def planning(program: Program) -> list[Diagnostic]:
    """What the planner says about a program."""
    return make_plan(program, STANFORD)[1]
