"""The planning phase finds what cannot be done before anything moves."""

import numpy as np
import pytest

from handeye.al import AL, compile_text
from handeye.arm.ik import solve
from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import Diagnostic
from handeye.core.pose import hand
from handeye.core.source import Source
from handeye.core.units import INCH
from handeye.planfile.plan import Plan
from handeye.planning.planner import plan_program
from handeye.program.motion_operations import Change
from handeye.program.taught import Taught

MIDDLE = (STANFORD.lower + STANFORD.upper) / 2


def plan_of(text: str) -> tuple[Plan | None, list[Diagnostic]]:
    program, diagnostics = compile_text(Source(name="test.al", text=text), Taught())
    assert program is not None, diagnostics
    return plan_program(program, STANFORD, AL)


def only(text: str) -> Diagnostic:
    plan, problems = plan_of(text)
    (problem,) = problems
    assert (plan is None) == (problem.severity == "error")
    return problem


@pytest.mark.row(2)
def test_row_2_change_displaces_from_the_present_place() -> None:
    plan, _ = plan_of("TRANS T [25 38 4 90 90 0]\nMOVE T\nCHANGE [0 0 -1] 0.6")
    assert plan is not None
    start, end = (forward(STANFORD, np.array(q))[:3, 3] for q in plan.motions[1].knots)
    assert end - start == pytest.approx([0, 0, -0.6 * INCH], abs=1e-9)


@pytest.mark.row(3)
def test_row_3_the_length_of_the_direction_does_not_matter() -> None:
    plan, _ = plan_of("TRANS T [25 38 4 90 90 0]\nMOVE T\nCHANGE [0 0 -2] 0.6")
    assert plan is not None
    operation = plan.program.steps[1].operation
    assert isinstance(operation, Change)
    assert operation.displacement == pytest.approx((0, 0, -0.6 * INCH))


@pytest.mark.row(39)
def test_row_39_a_wrist_inside_the_cylinder_is_found_in_planning() -> None:
    problem = only("TRANS T [20 15 5 90 90 0]\nMOVE T")
    assert problem.code == "unreachable-position"
    assert "the minimum is 6.1 in" in problem.notes[0]


@pytest.mark.row(40)
def test_row_40_a_hand_through_the_table_is_found_in_planning() -> None:
    problem = only("TRANS T [25 38 4 90 90 0]\nTRANS LOW [25 38 -1 90 90 0]\nMOVE T\nMOVE LOW")
    assert problem.code == "hand-through-table"
    assert problem.message == "the hand would be 1.00 in below the table at LOW"


def test_a_straight_motion_through_the_table_is_found_in_planning() -> None:
    assert only("TRANS T [25 38 1 90 90 0]\nMOVE T\nCHANGE [0 0 -1] 2").code == "hand-through-table"


def test_a_goal_out_of_reach_names_the_joint_and_the_amount() -> None:
    problem = only("TRANS T [25 38 4 90 90 0]\nTRANS FAR [53 53 4 90 90 0]\nMOVE T\nMOVE FAR")
    assert problem.notes[0] == "joint 3 (boom) would have to be at 54.5 in; its limit is 50.0 in"


def test_a_stop_beyond_the_arm_is_found_in_planning() -> None:
    problem = only("TRANS T [25 38 4 90 90 0]\nMOVE T\nSTOP [0 0 -3000]\nCHANGE [0 0 -1] 1")
    assert problem.code == "stop-beyond-arm"


def test_a_moment_beyond_the_arm_is_found_in_planning() -> None:
    problem = only("TRANS T [25 38 4 90 90 0]\nMOVE T\nSTOP NIL [0 0 3000]\nCHANGE [0 0 -1] 1")
    assert problem.code == "stop-beyond-arm"
    assert problem.message == "the arm cannot turn with 3000 oz-in here, so the stop would never fire"
    assert problem.help == "joint 6 (hand roll) reaches its limit at 1416 oz-in"


LED = "TRANS T [25 38 4 90 90 0]\nTRANS A {}\nTRANS U [15 38 4 90 90 0]\nMOVE T\nVIA A\nMOVE U"


def test_a_move_is_planned_by_way_of_its_via() -> None:
    plan, _ = plan_of(LED.format("[20 30 9 90 90 0]"))
    assert plan is not None
    motion = plan.motions[1]
    assert (len(motion.knots), len(motion.times)) == (5, 4)
    assert forward(STANFORD, np.array(motion.knots[2]))[:3, 3] / INCH == pytest.approx((20, 30, 9))


@pytest.mark.parametrize(
    ("at", "code", "message"),
    [
        ("[53 53 4 90 90 0]", "unreachable-position", "A is 4.49 in beyond the reach of the Stanford arm"),
        ("[20 30 -1 90 90 0]", "hand-through-table", "the hand would be 1.00 in below the table at A"),
    ],
)
def test_a_via_that_cannot_be_passed_is_told_by_its_name(at: str, code: str, message: str) -> None:
    text = LED.format(at)
    problem = only(text)
    assert (problem.code, problem.message) == (code, message)
    span = problem.primary.span
    assert text[span.start - 4 : span.end] == "VIA A"


def test_each_motion_is_planned_from_where_the_one_before_ends() -> None:
    plan, _ = plan_of("TRANS T [25 38 4 90 90 0]\nMOVE T\nCHANGE [0 1 0] 1\nMOVE T")
    assert plan is not None
    assert plan.motions[1].knots[-1] == plan.motions[2].knots[0]


@pytest.mark.parametrize("stop", ["[0 0 -600]", "600"])
def test_riddle_of_the_listing_explains_itself(stop: str) -> None:
    problem = only(f"TRANS T [25 38 4 90 90 0]\nMOVE T\nSTOP {stop}\nCHANGE [0 0 -1] .6")
    assert problem.code == "stop-beyond-arm"
    assert problem.notes[0].startswith(
        "in the listing printed in 1973, the second stop of the pin insertion can be read as 60"
    )


def test_stop_beyond_the_arm_is_no_riddle_at_another_force() -> None:
    problem = only("TRANS T [25 38 4 90 90 0]\nMOVE T\nSTOP [0 0 -900]\nCHANGE [0 0 -1] .6")
    assert problem.notes == ()


def test_a_position_defined_here_is_planned_where_the_hand_was_planned_to_be() -> None:
    plan, _ = plan_of("TRANS T [25 38 4 90 90 0]\nMOVE T\nCHANGE Z 1\nHERE UP\nMOVE T\nMOVE UP")
    assert plan is not None
    assert plan.program.positions["UP"].at[:3] == pytest.approx((25 * INCH, 38 * INCH, 5 * INCH), abs=1e-6)
    goal = forward(STANFORD, np.array(plan.motions[4].knots[-1]))[:3, 3]
    assert goal / INCH == pytest.approx((25, 38, 5), abs=1e-4)


def test_a_taught_position_defined_anew_is_taught_in_the_plan_and_planned_anew_behind_it() -> None:
    plan, _ = plan_of("TRANS T [25 38 4 90 90 0]\nMOVE T\nCHANGE Z 1\nHERE T\nCHANGE Z 2\nMOVE T")
    assert plan is not None
    assert plan.program.positions["T"].at[2] == pytest.approx(4 * INCH)
    assert forward(STANFORD, np.array(plan.motions[4].knots[-1]))[2, 3] / INCH == pytest.approx(5, abs=1e-4)


def test_a_program_planned_from_where_the_arm_stands_is_checked_from_there() -> None:
    program, _ = compile_text(Source(name="test.al", text="CHANGE Z -2"), Taught())
    assert program is not None
    high, low = (solve(STANFORD, hand(0.6, 0.9, z * INCH, 1.57, 1.57, 0), MIDDLE).q for z in (4, 1))
    assert plan_program(program, STANFORD, AL, start=high)[1] == []
    (problem,) = plan_program(program, STANFORD, AL, start=low)[1]
    assert problem.message == "the hand would be 1.00 in below the table at the end of this `CHANGE`"


def test_a_straight_motion_that_feels_its_way_goes_at_an_inch_a_second_and_a_free_one_at_two() -> None:
    plan, _ = plan_of(
        "TRANS T [25 38 6 90 90 0]\nMOVE T\nSTOP [0 0 -50]\nCHANGE [0 0 -1] 2\nCHANGE [0 0 1] 2"
    )
    assert plan is not None
    felt, free = (sum(plan.motions[step].times) for step in (1, 2))
    assert felt - free == pytest.approx(2 / 1 - 2 / 2, abs=0.05)
