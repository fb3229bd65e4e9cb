"""Where a program first closes the hand on a part that it has found."""

from short_runs import plan_of

from handeye.arm.robots.stanford import STANFORD
from handeye.core.resources import plans
from handeye.core.units import INCH
from handeye.planfile.store import read_plan
from handeye.planning.grasp_state import FirstGrasp, first_grasp
from handeye.program.program import Program
from handeye.program.vision_operations import Specific

SCRIPT = """
        OPEN    2
        MOVE    A
        CENTER  .5
        CLOSE   .5
        OPEN    1.5
        MOVE    T1
        CLOSE   .1
        OPEN    1.4
        MOVE    B
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5
        CENTER  .3
"""
"""A and B are of the base, T1 of the pump in its standard position."""


def found(after: int, part: str) -> FirstGrasp | None:
    return first_grasp(plan_of(SCRIPT).program, STANFORD.hand, after, part)


def seen(program: Program) -> int:
    """The step that locates the base by its holes."""
    return next(n for n, step in enumerate(program.steps) if isinstance(step.operation, Specific))


def test_the_pumps_program_first_closes_beside_the_large_hole() -> None:
    program = read_plan(plans() / "water_pump.plan.json").program
    grasp = first_grasp(program, STANFORD.hand, seen(program), "BASE")
    assert grasp == FirstGrasp(position="A", gap=1.775 * INCH)


def test_a_grasp_of_another_part_is_passed_over() -> None:
    assert found(-1, "PUMP") == FirstGrasp(position="T1", gap=1.5 * INCH)


def test_a_grasp_that_was_made_before_is_passed_over() -> None:
    assert found(2, "BASE") == FirstGrasp(position="B", gap=1.4 * INCH)


def test_a_part_that_is_never_grasped_has_no_first_grasp() -> None:
    assert found(6, "PUMP") is None
