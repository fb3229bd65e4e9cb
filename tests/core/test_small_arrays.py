import numpy as np
import pytest

from handeye.core.small_arrays import limited, span

VALUES = np.arange(20.0)


@pytest.mark.parametrize("indices", [[3], [4, 5, 6], [1, 3, 5], [0, 7, 14], []])
def test_evenly_spaced_elements_are_selected_by_a_slice(indices: list[int]):
    found = span(np.array(indices, dtype=np.intp))
    assert isinstance(found, slice)
    assert VALUES[found].tolist() == VALUES[indices].tolist() if indices else not len(VALUES[found])


@pytest.mark.parametrize("indices", [[3, 2, 1], [4, 4], [1, 2, 4], [0, 7, 13]])
def test_other_elements_are_selected_by_their_indices(indices: list[int]):
    assert VALUES[span(np.array(indices))].tolist() == VALUES[indices].tolist()


@pytest.mark.parametrize("limit", [2.0, np.array([2.0, 0.5, 7.0, 0.0, 1.0])])
def test_limited_values_are_those_of_numpy(limit: float | np.ndarray):
    values = np.array([-3.0, 0.5, 7.5, -0.0, np.nan])
    assert limited(values, limit).tobytes() == np.clip(values, -limit, limit).tobytes()
