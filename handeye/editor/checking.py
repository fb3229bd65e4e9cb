"""Everything there is to say about a script, the arm's reach included."""

from handeye.al import AL
from handeye.arm.robots.stanford import STANFORD
from handeye.diagnostics import Diagnostic
from handeye.planning.scripts import plan_program
from handeye.program.program import Program


def planning(program: Program) -> list[Diagnostic]:
    """Diagnostics of the planner for a program."""
    return plan_program(program, STANFORD, AL)[1]
