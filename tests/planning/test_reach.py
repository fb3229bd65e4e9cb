"""What the arm cannot reach is told with the joint and the amount, once, and for the whole way."""

import re

import numpy as np
import pytest
from checking import message, said

from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import hand_angles
from handeye.core.units import INCH


def test_a_goal_beyond_the_boom_says_how_far() -> None:
    (problem,) = said("TRANS FAR [25 60 4 90 90 0]\nMOVE FAR")
    assert problem.message == "FAR is 0.56 in beyond the reach of the Stanford arm"
    assert problem.notes == ("joint 3 (boom) would have to be at 50.6 in; its limit is 50.0 in",)
    assert problem.help == "move the position at least 0.56 in closer to the arm"


def test_a_goal_too_near_to_the_column_says_how_near() -> None:
    (problem,) = said("TRANS NEAR [20 15 5 90 90 0]\nMOVE NEAR")
    assert problem.message == "NEAR is 1.06 in too close to the column of the Stanford arm"
    assert problem.help == "move the position at least 1.07 in away from the arm"


@pytest.mark.parametrize("inches", [0.0035, 0.0081, 0.02, 0.7])
def test_a_goal_just_beyond_the_boom_is_told_with_digits_that_show_it(inches: float) -> None:
    X = forward(STANFORD, np.array([0.3, 1.7, (50 + inches) * INCH, 0.2, 1.0, 0.4]))
    at = " ".join(f"{x:.9f}" for x in (*X[:3, 3] / INCH, *np.degrees(hand_angles(X))))
    (problem,) = said(f"TRANS FAR [{at}]\nMOVE FAR")
    beyond, least = (float(re.findall(r"([\d.]+) in", text)[0]) for text in (problem.message, problem.help))
    assert beyond == pytest.approx(inches, rel=0.02)
    assert inches - 1e-7 <= least <= 1.04 * inches
    (note,) = problem.notes
    assert "50.0 in; its limit is 50.0 in" not in note


def test_a_wrist_beyond_its_limit_is_told_with_the_amount() -> None:
    assert message("TRANS B [25 38 14 90 -70 0]\nMOVE B") == (
        "joint-limit: `MOVE B` would take joint 5 (wrist bend) 5.5 degrees beyond its limit of 110 degrees"
    )


def test_a_straight_motion_says_where_it_leaves_the_reach() -> None:
    (problem,) = said("MOVE T\nCHANGE [0 1 0] 30")
    assert problem.code == "path-leaves-reach"
    assert problem.message == "21.5 in along this `CHANGE`, the hand would leave the arm's reach"
    assert problem.notes == ("joint 3 (boom) would have to be at 58.5 in; its limit is 50.0 in",)


def test_a_turn_says_where_it_comes_to_the_limit_of_a_joint() -> None:
    (problem,) = said("MOVE T\nTURN PEG 330")
    assert problem.code == "joint-limit"
    assert problem.notes == ("50.7 in along this `TURN`, the joint reaches its limit",)
    assert problem.help == "shorten the motion"


def test_a_free_motion_that_swings_beyond_a_limit_on_its_way_says_where() -> None:
    (problem,) = said(
        "TRANS A [26.44 13.42 1.83 -90 60 0]\nTRANS B [27.12 59.14 15.64 90 0 90]\nMOVE A\nMOVE B"
    )
    assert (
        problem.message == "`MOVE` would take joint 1 (column) 1.2 degrees beyond its limit of -170 degrees"
    )
    assert problem.notes == ("159.1 in along its way to B, the joint reaches its limit",)
    assert problem.help == "use `VIA` to add a position on the way"


def test_a_straight_motion_through_the_singularity_is_found() -> None:
    assert message("TRANS AHEAD [13.937 40 24 180 0 0]\nMOVE AHEAD\nCHANGE [0 0 -1] 4") == (
        "wrist-in-line: 1.4 in along this `CHANGE`, the hand could not keep its angles"
    )


def test_a_straight_motion_that_is_too_fast_for_a_joint_is_found() -> None:
    (problem,) = said("TRANS NEAR [20 28 8 90 90 0]\nMOVE NEAR\nCHANGE [1 0 0] 10 70")
    assert problem.code == "joint-too-fast"
    assert problem.notes == (
        "joint 1 (column) would have to move at 192 degrees/s; its limit is 172 degrees/s",
    )


@pytest.mark.parametrize("first", ["MOVE FAR", "TRANS LOW [25 38 -1 90 90 0]\nMOVE LOW"])
def test_motions_from_a_place_that_is_not_reached_are_not_judged(first: str) -> None:
    text = f"TRANS FAR [25 60 4 90 90 0]\nMOVE T\n{first}\nCHANGE [0 0 -1] 6\nCHANGE [0 1 0] 40\nMOVE OVER"
    assert len(said(text)) == 1


def test_every_goal_out_of_reach_is_told_and_not_the_first_alone() -> None:
    text = "TRANS F [25 60 4 90 90 0]\nTRANS G [25 61 4 90 90 0]\nMOVE F\nMOVE G\nMOVE T\nCHANGE [0 1 0] 30"
    assert [p.code for p in said(text)] == ["unreachable-position"] * 2 + ["path-leaves-reach"]


def test_a_goal_out_of_reach_is_told_where_it_is_first_gone_to_and_not_again() -> None:
    (problem,) = said("TRANS FAR [25 60 4 90 90 0]\nMOVE FAR\nMOVE T\nMOVE FAR")
    assert problem.primary.span.start == len("TRANS FAR [25 60 4 90 90 0]\nMOVE ")


def test_a_long_script_of_mistakes_gets_no_more_messages_than_anybody_reads() -> None:
    assert len(said("MOVE T\n" + "CHANGE [0 1 0] 30\nMOVE T\n" * 30)) == 20


@pytest.mark.parametrize(
    "line", ["FAR: MOVE FAR ;FAR", "  move FAR DIRECT", "DEFINE TO_FAR\nMOVE FAR\n\nTO_FAR"]
)
def test_the_goal_is_marked_and_not_a_label_or_comment_like_it(line: str) -> None:
    text = f"TRANS FAR [25 60 4 90 90 0]\n{line}"
    (problem,) = said(text)
    span = problem.primary.span
    assert text[span.start : span.end] == "FAR"
    assert text[: span.start].rstrip().lower().endswith("move")


@pytest.mark.parametrize(
    ("via", "code"),
    [("[25 60 4 90 90 0]", "unreachable-position"), ("[25 38 -1 90 90 0]", "hand-through-table")],
)
def test_a_position_on_the_way_that_cannot_be_passed_is_marked_in_its_via(via: str, code: str) -> None:
    text = f"TRANS BY {via}\nMOVE OVER\nVIA BY\nMOVE T"
    (problem,) = said(text)
    assert problem.code == code
    assert problem.primary.span.start == text.index("VIA BY") + len("VIA ")
