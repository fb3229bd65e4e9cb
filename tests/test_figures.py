"""Recorded text is compared to the last place of its figures but one, forces to an ounce and a half, and to the letter
besides."""

import pytest
from figures import as_recorded

RECORDED = "pressed with 61.0 ounces after 5.27 s in stage 4\n"


@pytest.mark.parametrize("figure", ["5.24", "5.27", "5.30"])
def test_a_figure_may_differ_in_its_last_place(figure: str) -> None:
    assert as_recorded(RECORDED.replace("5.27", figure), RECORDED) == RECORDED


@pytest.mark.parametrize("figure", ["59.5", "61.0", "62.5"])
def test_a_force_may_differ_by_an_ounce_and_a_half(figure: str) -> None:
    assert as_recorded(RECORDED.replace("61.0", figure), RECORDED) == RECORDED


@pytest.mark.parametrize(
    ("was", "now"),
    [("61.0", "62.6"), ("5.27", "5.31"), ("61.0", "61.01"), ("61.0", "61"), ("5.27", "-5.27"), ("4", "5"),
     ("ounces", "pounds"), ("\n", "\nonce more 61.0\n")],
)  # fmt: skip
def test_every_other_difference_stays(was: str, now: str) -> None:
    assert as_recorded(RECORDED.replace(was, now), RECORDED) != RECORDED
