"""What is in the way of the hand, and of what it holds, is found along the whole planned motion."""

import pytest
from checking import message, said
from figures import as_recorded

IN_HAND = "OPEN 1\nMOVE PEG\nCLOSE .2\n"


def test_a_goal_inside_a_fixture_is_found() -> None:
    assert message("TRANS IN [32 46 1 90 90 0]\nMOVE IN") == (
        "hand-through-fixture: the hand would go 0.75 in into `STAND` at IN"
    )


def test_a_fixture_on_the_way_is_found_with_the_place() -> None:
    deepest = "hand-through-fixture: 4.9 in along its way to EAST, the hand would go 0.77 in into `STAND`"
    assert as_recorded(message("MOVE WEST\nMOVE EAST DIRECT"), deepest) == deepest


def test_departure_and_approach_lead_over_a_fixture() -> None:
    assert said("MOVE WEST\nMOVE EAST") == []


def test_a_straight_motion_into_a_fixture_is_found_with_its_depth() -> None:
    assert message("MOVE OVER\nCHANGE [0 0 -1] 1") == (
        "hand-through-fixture: the hand would go 0.75 in into `STAND` at the end of this `CHANGE`"
    )


@pytest.mark.parametrize("modifier", ["STOP [0 0 -20]", "STOP 20", "FORCE [0 0 -20]"])
def test_a_motion_that_feels_its_way_may_meet_a_fixture(modifier: str) -> None:
    assert said(f"MOVE OVER\n{modifier}\nCHANGE [0 0 -1] 1") == []


def test_what_begins_inside_a_fixture_may_leave_it() -> None:
    """A guarded motion is planned to its end, and not to where the fixture stops it."""
    assert said("MOVE OVER\nSTOP 20\nCHANGE [0 0 -1] 1\nCHANGE [0 0 1] 1\nMOVE T") == []


def test_wide_fingers_meet_what_narrow_ones_pass() -> None:
    beside = "TRANS BY [32 43 1 90 90 0]\nMOVE BY"
    assert said(f"OPEN 1\n{beside}") == []
    assert message(f"OPEN 2\n{beside}") == (
        "hand-through-fixture: the hand would go 0.40 in into `STAND` at BY"
    )


def test_the_palm_counts_and_not_the_fingers_alone() -> None:
    assert message("TRANS FLAT [35.5 46 2.5 90 0 0]\nMOVE FLAT") == (
        "hand-through-fixture: the hand would go 0.79 in into `STAND` at FLAT"
    )


def test_what_the_hand_holds_goes_through_a_fixture_where_the_hand_does_not() -> None:
    assert said("MOVE OVER") == []
    (problem,) = said(f"{IN_HAND}MOVE OVER")
    assert (problem.code, problem.severity) == ("carries-through-fixture", "warning")
    assert problem.message == "`STICK` in the hand would go 1.25 in into `STAND` at OVER"
    (grasp,) = problem.secondary
    assert (grasp.text, grasp.span.start) == ("grasped here", len("OPEN 1\nMOVE PEG\n"))


def test_what_the_hand_has_let_go_is_not_carried() -> None:
    assert said(f"{IN_HAND}OPEN 1\nMOVE OVER") == []


def test_what_the_hand_closes_on_elsewhere_is_unknown() -> None:
    assert said("MOVE T\nCLOSE\nMOVE OVER") == []


def test_a_hand_that_lies_flat_goes_through_the_table_by_its_palm() -> None:
    assert message("TRANS FLAT [25 38 1 90 0 0]\nMOVE FLAT") == (
        "hand-through-table: the hand would be 0.54 in below the table at FLAT"
    )


def test_what_the_hand_holds_goes_through_the_table() -> None:
    assert message(f"{IN_HAND}CHANGE [0 0 -1] 1") == (
        "carries-through-table: `STICK` in the hand would be 0.50 in below the table at the end of this `CHANGE`"
    )


def test_a_motion_comes_from_nowhere_known_after_a_jump_to_it() -> None:
    """`EAST` is come to from `T` and not from `WEST`, which stands before it in the text."""
    text = (
        "CLOSE\nSKIPE 2\nJUMP OTHER\nMOVE WEST\nJUMP END\nOTHER: MOVE T\nJUMP IT\nIT: MOVE WEST\nEND: OPEN 1"
    )
    assert said(text) == []
    assert said("CLOSE\nSKIPE 2\nJUMP A\nMOVE WEST\nJUMP B\nA: MOVE EAST DIRECT\nB: OPEN 1") == []


def test_what_is_held_where_only_a_jump_leads_is_unknown() -> None:
    text = f"CLOSE\nSKIPE 2\nJUMP EMPTY\n{IN_HAND}LOAD 270\nMOVE PEG\nJUMP END\nEMPTY: MOVE OVER\nEND: OPEN 1"
    assert said(text) == []


def test_one_motion_gets_one_message() -> None:
    assert [p.code for p in said(f"{IN_HAND}TRANS IN [32 46 1 90 90 0]\nMOVE IN\nMOVE T")] == [
        "hand-through-fixture"
    ]


def test_a_position_between_leads_past_a_fixture_or_into_it() -> None:
    past, into = "TRANS BY [32 40 1 90 90 0]\n", "TRANS BY [32 46 1.5 90 90 0]\n"
    way = "MOVE WEST\nVIA BY\nMOVE EAST DIRECT"
    assert said(past + way) == []
    assert message(into + way).startswith("hand-through-fixture: ")


@pytest.mark.parametrize("deep", [0.02, 0.06, 0.09, 0.11, 0.3])
def test_a_motion_along_what_it_begins_in_is_not_told(deep: float) -> None:
    beside = f"TRANS BY [32 {42.825 + deep:.3f} 1 90 90 0]\nOPEN 1.55\nMOVE BY"
    assert len(said(beside)) == (deep > 0.1)
    assert len(said(f"{beside}\nCHANGE [0 0 -1] .3")) == (deep > 0.1)
