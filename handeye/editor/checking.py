"""Everything there is to say about a script, the arm's reach included."""

from handeye.arm.robots.stanford import STANFORD
from handeye.diagnostics import Diagnostic
from handeye.planning.planner import make_plan
from handeye.program.program import Program


def planning(program: Program) -> list[Diagnostic]:
    """What the planner says about a program."""
    return make_plan(program, STANFORD)[1]
