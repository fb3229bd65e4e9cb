"""Rows that are enough: whatever is left out lies nearly on the straight ways between them."""

import numpy as np
import pytest

from handeye.core.polyline import needed_rows, off_poses, off_values, smooth


def test_what_lies_on_a_line_is_left_out_and_a_peak_is_kept() -> None:
    values = np.where(np.arange(101) == 40, 7.0, 0.0)
    kept = needed_rows(off_values(values, np.arange(101.0), np.ones(101)), [0, 100])
    assert kept.tolist() == [0, 39, 40, 41, 100]


def test_rows_that_are_wanted_are_kept_whatever_they_hold() -> None:
    assert needed_rows(off_values(np.zeros(9), np.arange(9.0), np.ones(9)), [0, 3, 8]).tolist() == [0, 3, 8]


def test_a_way_is_straight_in_time_and_not_in_rows() -> None:
    times = np.array([0.0, 1.0, 10.0])
    assert needed_rows(off_values(times, times, np.full(3, 0.1)), [0, 2]).tolist() == [0, 2]
    assert needed_rows(off_values(times, np.arange(3.0), np.full(3, 0.1)), [0, 2]).tolist() == [0, 1, 2]


@pytest.mark.parametrize(
    ("place", "turn", "kept"), [(1e-2, 1.0, [0, 2]), (1e-3, 1.0, [0, 1, 2]), (1e-2, 0.1, [0, 1, 2])]
)
def test_a_pose_may_be_off_by_so_much_and_turned_by_so_much(
    place: float, turn: float, kept: list[int]
) -> None:
    half = np.array([np.cos(0.1), 0, 0, np.sin(0.1)])  # turned by .2 rad
    poses = np.array([[0, 0, 0, 1, 0, 0, 0], [0, 0, 5e-3, *half], [0, 0, 0, 1, 0, 0, 0]], dtype=float)
    assert needed_rows(off_poses(poses, np.arange(3.0), place=place, turn=turn), [0, 2]).tolist() == kept


def test_a_whole_turn_is_not_taken_for_standing_still() -> None:
    quarter = np.sqrt(0.5)
    turning = [(1, 0), (quarter, quarter), (0, 1), (-quarter, quarter), (-1, 0)]
    poses = np.array([[0, 0, 0, w, 0, 0, z] for w, z in turning], dtype=float)
    kept = needed_rows(off_poses(poses, np.arange(5.0), place=1.0, turn=0.1), [0, 4])
    assert kept.tolist() == [0, 2, 4]


def test_a_quaternion_and_its_opposite_are_one_rotation() -> None:
    poses = np.array([[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, -1, 0, 0, 0]], dtype=float)
    assert smooth(poses)[1].tolist() == poses[0].tolist()
