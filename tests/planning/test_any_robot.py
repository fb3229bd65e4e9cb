"""The planner plans for any robot: free and straight motions, and refusals in words."""

import msgspec
import numpy as np
import pytest
from robots import CARTESIAN, GANTRY, PLANAR, ROBOTS

from handeye.al import AL, compile_text
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.arm.robots import register
from handeye.core.diagnostics import Diagnostic
from handeye.core.errors import InvalidInput
from handeye.core.source import Source
from handeye.core.units import INCH
from handeye.inspection.difference import difference
from handeye.inspection.difference_text import difference_text
from handeye.planfile.plan import Plan
from handeye.planning.planner import plan_program
from handeye.program.taught import Taught
from handeye.tasks import task

Y = 0.95 / INCH
"""Where all of them reach, in."""
HEAD = f"TRANS PARK [25 {Y} 8 90 90 0]\nTRANS A [30 {Y} 4 90 90 0]\nTRANS B [22 {Y} 5 90 90 0]\n"
SCRIPT = f"""{HEAD}
OPEN 2
MOVE A
CHANGE [0 0 -1] 1.5
CLOSE .1
CHANGE [1 0 0] 2
CHANGE [-1 0 2] 1
VIA PARK
MOVE B
"""


def planned(arm: ArmModel, text: str) -> tuple[Plan | None, list[Diagnostic]]:
    program, diagnostics = compile_text(Source(name="test.al", text=text), Taught())
    assert program is not None, diagnostics
    return plan_program(program, arm, AL)


@pytest.mark.parametrize("name", ROBOTS)
def test_a_script_becomes_motions_with_one_position_for_each_joint(name: str) -> None:
    arm = ROBOTS[name].arm
    plan, problems = planned(arm, SCRIPT)
    assert plan is not None, problems
    assert {len(knot) for motion in plan.motions.values() for knot in motion.knots} == {len(arm.joints)}
    ends = [forward(arm, np.array(motion.knots[-1]))[:3, 3] / INCH for motion in plan.motions.values()]
    wanted = [
        [30, Y, 4],
        [30, Y, 2.5],
        [32, Y, 2.5],
        [32 - 1 / np.sqrt(5), Y, 2.5 + 2 / np.sqrt(5)],
        [22, Y, 5],
    ]
    np.testing.assert_allclose(ends, wanted, atol=1e-6)


def refused(arm: ArmModel, position: str) -> Diagnostic:
    """What is said against going to a position."""
    plan, (problem,) = planned(arm, f"{HEAD}TRANS C {position}\nMOVE C\n")
    assert plan is None
    return problem


@pytest.mark.parametrize(
    ("arm", "position", "note"),
    [
        (
            GANTRY,
            f"[55 {Y} 4 90 90 0]",
            "joint 3 (carriage) would have to be at 45.2 in; its limit is 39.4 in",
        ),
        (GANTRY, f"[30 {Y} 45 90 90 0]", "joint 4 (mast) would have to be at -3.7 in; its limit is 0.0 in"),
        (CARTESIAN, "[30 2 4 90 90 0]", "joint 2 (y) would have to be at 2.0 in; its limit is 3.9 in"),
        (
            CARTESIAN,
            f"[30 {Y} 4 60 90 0]",
            "the hand would have to turn by 30.0 degrees about an axis for which the cartesian arm has no joint",
        ),
        (
            PLANAR,
            f"[30 {Y + 2} 4 90 90 0]",
            "the hand would have to be 2.00 in off the plane in which joint 1 (x) and joint 2 (z) move the hand",
        ),
    ],
)
def test_a_position_out_of_the_robot_s_power_is_refused_in_words(
    arm: ArmModel, position: str, note: str
) -> None:
    problem = refused(arm, position)
    assert problem.code == "unreachable-position"
    assert problem.notes == (note,)


def test_a_hand_that_would_point_too_far_up_is_refused_by_the_joint_that_ends() -> None:
    problem = refused(GANTRY, f"[30 {Y} 20 90 -30 0]")
    assert problem.code == "joint-limit"
    assert "would take joint 6 (pitch) 20.0 degrees beyond its limit of -100 degrees" in problem.message


@pytest.mark.parametrize("name", ROBOTS)
def test_a_straight_motion_out_of_the_robot_s_power_says_where_it_ends(name: str) -> None:
    plan, (problem,) = planned(ROBOTS[name].arm, f"{HEAD}MOVE A\nCHANGE [1 0 0] 40\n")
    assert plan is None
    assert problem.code == "path-leaves-reach"
    assert "in along this `CHANGE`" in problem.message


def test_a_motion_that_comes_out_otherwise_is_told_by_the_robot_s_own_joints() -> None:
    register(GANTRY)
    plans = [planned(GANTRY, f"{HEAD}TRANS C [{x} {Y} 4 90 90 0]\nMOVE C\n")[0] for x in (30, 31)]
    assert plans[0] is not None
    assert plans[1] is not None
    assert "the end position of joint 3 (carriage) changes by +1 in" in "\n".join(
        difference_text(difference(*plans))
    )


def test_motions_of_different_robots_are_told_apart_without_a_joint() -> None:
    text = f"{HEAD}MOVE A\n"
    plans = [planned(arm, text)[0] for arm in (GANTRY, CARTESIAN)]
    assert plans[0] is not None
    assert plans[1] is not None
    (change,) = difference(*plans).steps
    assert change.motion is not None
    assert change.motion.joint is None


@pytest.mark.parametrize("joints", [0, 5])
def test_a_plan_with_positions_of_fewer_joints_than_its_arm_is_not_run(joints: int) -> None:
    plan, _ = planned(ROBOTS["stanford"].arm, f"{HEAD}MOVE A\n")
    assert plan is not None
    motion = plan.motions[0]
    cut = msgspec.structs.replace(motion, knots=tuple(knot[:joints] for knot in motion.knots))
    with pytest.raises(
        InvalidInput, match=rf"^the plan has positions of {joints} joints; the Stanford arm has 6$"
    ):
        task().check_arm(msgspec.structs.replace(plan, motions={0: cut}))
