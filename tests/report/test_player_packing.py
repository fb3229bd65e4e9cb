"""What is packed comes back as it was, within its bits."""

import numpy as np
import pytest
from player_bytes import Unpacked

from handeye.report.player.packing import columns, octahedral, packed, quantised, zigzag


def test_numbers_that_go_up_and_down_come_back() -> None:
    values = np.array([0, 5, 3, 2**30 + 7, 1, 1, 0])
    assert Unpacked.of(packed({}, {"values": zigzag(values)})).summed("values").tolist() == values.tolist()


def test_rows_come_back_across_the_end_of_their_range() -> None:
    rows = np.random.default_rng(1).integers(0, 1 << 16, (50, 3))
    data = Unpacked.of(packed({}, {"rows": columns(rows), "odd": np.zeros(3, dtype=np.uint8)}))
    assert data.rows("rows", 3).tolist() == rows.tolist()
    assert data.array("odd").tolist() == [0, 0, 0]


def test_points_come_back_within_their_range_over_65536() -> None:
    points = np.random.default_rng(2).uniform(-3, 5, (80, 3))
    numbers, (*least, step) = quantised(points)
    assert np.abs(least + numbers * step - points).max() < 8 / 65536
    assert quantised(np.ones((2, 3)))[0].tolist() == [[0, 0, 0]] * 2


@pytest.mark.parametrize("down", [False, True])
def test_normals_come_back_within_a_degree_on_either_half_of_the_octahedron(*, down: bool) -> None:
    normals = np.random.default_rng(3).normal(size=(500, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    normals[:, 2] = -np.abs(normals[:, 2]) if down else np.abs(normals[:, 2])
    x, y = octahedral(normals).T / 127
    z = 1 - abs(x) - abs(y)
    folded = (1 - abs(y)) * np.where(x < 0, -1, 1), (1 - abs(x)) * np.where(y < 0, -1, 1)
    back = np.column_stack([np.where(z < 0, folded[0], x), np.where(z < 0, folded[1], y), z])
    back /= np.linalg.norm(back, axis=1, keepdims=True)
    assert np.degrees(np.arccos(np.einsum("ij,ij->i", back, normals).clip(-1, 1))).max() < 1.0
