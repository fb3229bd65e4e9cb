"""Two runs side by side: each step beside its fellow, and where one does more, the other waits."""

import pytest
from told_runs import told

from handeye.comparison.pairing import Course, TwoRuns, course

OPEN, GRASP, LIFT = ("OPEN", ()), ("CLOSE", ()), ("CHANGE  [0 0 1]", ())


def shown(way: Course) -> list[tuple[float, float, float, str, str]]:
    """Time of the course, times of both runs, and the words of both steps, leg by leg."""
    words = (
        (leg, *("" if place is None else place.text.split()[0] for place in leg.places)) for leg in way.legs
    )
    return [(leg.begin, leg.a, leg.b, one, other) for leg, one, other in words]


def test_the_same_steps_are_beside_each_other() -> None:
    way = course(TwoRuns(told(OPEN, GRASP), told(OPEN, GRASP)))
    assert shown(way)[1:] == [(1.0, 1.0, 1.0, "OPEN", "OPEN"), (2.0, 2.0, 2.0, "CLOSE", "CLOSE")]
    assert (way.end, way.a, way.b) == pytest.approx((2.9, 2.9, 2.9))


def test_a_run_waits_while_the_other_does_a_step_alone() -> None:
    way = course(TwoRuns(told(OPEN, GRASP, LIFT), told(OPEN, LIFT)))
    assert shown(way)[2:] == [(2.0, 2.0, 2.0, "CLOSE", ""), (3.0, 3.0, 2.0, "CHANGE", "CHANGE")]
    assert (way.a, way.b) == pytest.approx((3.9, 2.9))


def test_a_step_lasts_as_long_as_the_longer_of_both() -> None:
    slow = told(OPEN, GRASP, LIFT)
    way = course(TwoRuns(slow, told(OPEN, LIFT)))
    legs = shown(course(TwoRuns(told(OPEN, LIFT), slow)))
    assert [leg[0] for leg in legs] == [leg.begin for leg in way.legs]
    assert legs[2][3:] == ("", "CLOSE")


def test_a_step_of_either_run_is_found_on_the_course() -> None:
    way = course(TwoRuns(told(OPEN, LIFT), told(OPEN, GRASP, LIFT)))
    lifts = way.legs[-1].places
    assert lifts[0] is not None
    assert lifts[1] is not None
    assert way.at(lifts[0], 0) == way.at(lifts[1], 1) == 3.0


def test_runs_that_did_nothing_have_a_course_of_one_leg() -> None:
    way = course(TwoRuns(told(), told()))
    assert [leg.places for leg in way.legs] == [(None, None)]
