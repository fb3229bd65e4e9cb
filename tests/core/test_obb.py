"""Boxes against brute force: points inside them, and moving one out of the other."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from handeye.core.obb import Box, depths, lowest
from handeye.core.pose import Array, Pose, hand, inverse, pose, rotation_x, rotation_z

UNIT: Box = (-1.0, -1.0, -1.0, 1.0, 1.0, 1.0)
PLATE: Box = (0.0, -1.0, 2.0, 3.0, 1.0, 2.5)
place = st.floats(-3, 3)
angle = st.floats(-3, 3)
poses = st.builds(hand, place, place, place, angle, angle, angle)


def depth(X_BA: Pose, box: Box, other: Box) -> float:
    return float(depths(X_BA[None, None], [box], [other])[0, 0, 0])


def corners(box: Box) -> Array:
    return np.array([(x, y, z) for x in box[::3] for y in box[1::3] for z in box[2::3]])


@pytest.mark.parametrize(("x", "deep"), [(0.0, 2.0), (1.5, 0.5), (2.0, 0.0), (5.0, 0.0)])
def test_upright_boxes_overlap_by_the_shortest_way_out(x: float, deep: float) -> None:
    assert depth(pose(np.eye(3), (x, 0.1, 0.0)), UNIT, UNIT) == pytest.approx(min(deep, 1.9))


def test_a_corner_turned_towards_a_face_reaches_farther() -> None:
    R = hand(0, 0, 0, np.pi / 4, np.pi / 2, 0)[:3, :3]
    assert depth(pose(R, (2.2, 0.0, 0.0)), UNIT, UNIT) == pytest.approx(np.sqrt(2) - 1.2)


@pytest.mark.parametrize(("apart", "deep"), [(0.27, 0.2 * np.sqrt(2) - 0.27), (0.29, 0.0)])
def test_bars_that_cross_edge_to_edge_are_parted_by_no_face(apart: float, deep: float) -> None:
    bar: Box = (-3.0, -0.1, -0.1, 3.0, 0.1, 0.1)
    along_x = pose(rotation_x(np.pi / 4), (0.0, 0.0, apart))
    along_y = pose(rotation_z(np.pi / 2) @ rotation_x(np.pi / 4), (0.0, 0.0, 0.0))
    assert depth(inverse(along_y) @ along_x, bar, bar) == pytest.approx(deep)


def touching(X_BA: Pose, box: Box, other: Box) -> bool:
    """Whether any of many points of a box lies in the other."""
    low, high = np.array(box[:3]), np.array(box[3:])
    share = np.stack(np.meshgrid(*[np.linspace(0, 1, 15)] * 3), axis=-1).reshape(-1, 3)
    points = (low + share * (high - low)) @ X_BA[:3, :3].T + X_BA[:3, 3]
    inside = (points >= np.array(other[:3]) + 1e-9) & (points <= np.array(other[3:]) - 1e-9)
    return bool(inside.all(axis=1).any())


@given(poses)
def test_boxes_that_share_a_point_overlap(X_BA: Pose) -> None:
    assert depth(X_BA, UNIT, PLATE) > 0 or not touching(X_BA, UNIT, PLATE)


@given(poses, st.tuples(place, place, place))
def test_no_way_out_is_shorter_than_the_depth(X_BA: Pose, way: tuple[float, float, float]) -> None:
    deep = depth(X_BA, UNIT, PLATE)
    size = np.linalg.norm(way)
    if deep > 0 and size > 0:
        X_BA[:3, 3] += np.array(way) / size * 0.99 * deep
        assert depth(X_BA, UNIT, PLATE) > 0


@given(poses)
def test_the_lowest_height_is_that_of_a_corner(X_WA: Pose) -> None:
    heights = corners(PLATE) @ X_WA[2, :3] + X_WA[2, 3]
    assert lowest(X_WA[None], [PLATE])[0, 0] == pytest.approx(heights.min())
