"""A finding stands on the value as it was measured, and not on what is printed of it."""

import math

import pytest

from handeye.judge.finding import all_right, at_least, at_most, worse


@pytest.mark.parametrize(("value", "ok"), [(0.5, True), (0.500001, False), (math.nan, False), (-1.0, True)])
def test_a_value_may_reach_its_upper_limit_and_not_pass_it(value: float, *, ok: bool) -> None:
    assert at_most(value, 0.5, "mm", "a gap").ok is ok


@pytest.mark.parametrize(
    ("value", "ok"), [(40.0, True), (39.999999, False), (math.nan, False), (math.inf, True)]
)
def test_a_value_may_reach_its_lower_limit_and_not_pass_it(value: float, *, ok: bool) -> None:
    assert at_least(value, 40.0, "N", "a clamp").ok is ok


def test_one_wrong_point_makes_the_work_wrong() -> None:
    right, wrong = at_most(0.1, 0.5, "mm", "a gap"), at_least(1.0, 40.0, "N", "a clamp")
    assert all_right({"gap": right})
    assert not all_right({"gap": right, "clamp": wrong})


def test_a_caution_is_no_right_finding_and_makes_no_work_wrong() -> None:
    scar = at_most(1, 0, "threads", "scarred threads", caution=True)
    assert (scar.ok, scar.refuses, all_right({"scar": scar})) == (False, False, True)


def test_a_limit_that_somebody_sets_refuses_where_the_referees_own_cautions() -> None:
    scar = at_most(1, 0, "threads", "scarred threads", caution=True)
    assert not all_right({"scar": scar.limited(0)})


@pytest.mark.parametrize(("first", "second"), [(0.4, 0.6), (0.6, 0.4), (math.nan, 0.4), (0.4, math.nan)])
def test_of_two_looks_the_one_farther_beyond_its_limit_counts(first: float, second: float) -> None:
    one, other = ({"gap": at_most(value, 0.5, "mm", "a gap")} for value in (first, second))
    assert not all_right(worse(one, other))


def test_of_two_looks_against_different_limits_the_one_farther_beyond_counts() -> None:
    narrow, wide = at_most(0.4, 0.5, "mm", "a gap"), at_most(0.6, 0.9, "mm", "a gap")
    assert worse({"gap": narrow}, {"gap": wide}) == {"gap": narrow}


def test_a_referee_that_looked_at_nothing_has_found_nothing_right() -> None:
    assert not all_right({})
