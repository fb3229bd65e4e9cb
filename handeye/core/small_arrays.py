"""Operations on arrays of a few numbers. On such arrays, these functions are several times as fast as NumPy's own."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

Span = slice | NDArray[np.integer[Any]]


def limited(values: Array, limit: Array | float) -> Array:
    """Limit each value to a magnitude of at most `limit`."""
    return np.minimum(np.maximum(values, -limit), limit)


def span(indices: NDArray[np.integer[Any]]) -> Span:
    """Return a slice that selects the same elements as the indices, or the indices themselves if they are not evenly
    spaced.
    """
    count = len(indices)
    first, step = int(indices[0]) if count else 0, int(indices[1] - indices[0]) if count > 1 else 1
    even = step > 0 and (indices == first + step * np.arange(count)).all()
    return slice(first, first + step * count, step) if even else indices
