"""Figures are drawn to scale, with no more points than it takes."""

import numpy as np
import pytest

from handeye.report.page.plots import Scale, kept_points
from handeye.report.page.referee import used
from handeye.results.result import Check


def test_a_scale_leads_from_ends_to_ends() -> None:
    scale = Scale(2.0, 4.0, 90.0, 10.0)
    assert [scale(value) for value in (2, 3, 4)] == [90, 50, 10]


def test_points_on_a_line_are_left_out_and_a_peak_is_kept() -> None:
    xs = np.arange(101.0)
    points = np.column_stack([xs, np.where(xs == 40, 7.0, 0.0)])
    assert kept_points(points, 0.4)[:, 0].tolist() == [0, 39, 40, 41, 100]


def test_no_point_is_farther_from_the_curve_than_the_tolerance() -> None:
    rng = np.random.default_rng(1973)
    points = np.column_stack([np.arange(300.0), rng.normal(0, 1, 300).cumsum()])
    kept = kept_points(points, 0.4)
    drawn = np.interp(points[:, 0], kept[:, 0], kept[:, 1])
    steepest = np.abs(np.diff(kept[:, 1]) / np.diff(kept[:, 0])).max()
    assert len(kept) < 250
    assert np.abs(drawn - points[:, 1]).max() <= 0.4 * np.hypot(1, steepest)


@pytest.mark.parametrize(
    ("value", "relation", "limit", "unit", "share"),
    [
        (0.3, "at most", 0.6, "mm", 0.5),
        (80.0, "at least", 40.0, "N", 0.5),
        (-1.0, "at least", -5.0, "mm", 0.2),
        (1.0, "at least", -5.0, "mm", 0.0),
        (6.0, "at least", 6.0, "screws", None),
        (0.0, "at most", 0.0, "mm", None),
        (0.0, "at least", 40.0, "N", None),
    ],
)
def test_the_share_of_a_limit_that_a_value_uses(
    value: float, relation: str, limit: float, unit: str, share: float | None
) -> None:
    check = Check(ok=True, subject="it", value=value, relation=relation, limit=limit, unit=unit, sentence="")
    assert used(check) == share
