"""Checks a script with the planner, for the default task."""

from handeye.al import AL
from handeye.arm.model import ArmModel
from handeye.core.diagnostics import Diagnostic
from handeye.planning.planner import plan_program
from handeye.program.program import Program
from handeye.tasks import task


def arm() -> ArmModel:
    """Return the arm for which scripts are checked."""
    return task().arm


def planning(program: Program) -> list[Diagnostic]:
    """Return the planner's diagnostics for a program."""
    return plan_program(program, arm(), AL)[1]
