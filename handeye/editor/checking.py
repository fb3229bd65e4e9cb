"""Checks a script with the planner and the prover, for the default task."""

from handeye.al import AL
from handeye.arm.model import ArmModel
from handeye.core.diagnostics import Diagnostic
from handeye.core.variation import WorldSpec
from handeye.planning.planner import plan_program
from handeye.program.program import Program
from handeye.proof.argument import unproved
from handeye.proof.proof import prove
from handeye.tasks import task


def arm() -> ArmModel:
    """Return the arm for which scripts are checked."""
    return task().arm


def planning(program: Program) -> list[Diagnostic]:
    """Return the planner's diagnostics for a program."""
    return plan_program(program, arm(), AL)[1]


def proving(program: Program) -> list[Diagnostic]:
    """Return the diagnostics of `handeye check --prove` for a program."""
    return unproved(prove(program, task().obligations(WorldSpec(seed=0))), program)
