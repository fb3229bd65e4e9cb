"""Simplifies recordings: keeps only those rows from which all other rows can be interpolated linearly within a
tolerance.
"""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

_LEAST: Final = 1e-9  # least norm of an interpolated quaternion; halfway between opposites it is zero

Rows = NDArray[np.int64]
Off = Callable[[Rows, Rows, Rows], Array]
"""Function that returns, for each of n rows, the deviation from linear interpolation, in multiples of the tolerance,
shape (n,). Its arguments are, for each row: the first row of the segment, the row itself, and the last row of the
segment.
"""


def needed_rows(off: Off, always: Sequence[int] | Rows) -> Rows:
    """Find the rows from which all other rows can be interpolated within the tolerance. The result includes the rows
    in `always`, which must be sorted and contain the first and last row.

    The search starts with the segments between the rows in `always`. A segment with a row too far from the
    interpolation is split at the farthest row. All segments are handled together.
    """
    kept = [np.asarray(always, dtype=np.int64)]
    first, last = kept[0][:-1], kept[0][1:]
    while (long := last - first > 1).any():
        first, last = first[long], last[long]
        worst, most = _worst(off, first, last)
        cut = most > 1
        kept.append(worst[cut])
        first, last = np.append(first[cut], worst[cut]), np.append(worst[cut], last[cut])
    return np.sort(np.concatenate(kept))


def _worst(off: Off, first: Rows, last: Rows) -> tuple[Rows, Array]:
    """Find, for each segment, the row between its ends that deviates most. Returns these rows and their deviations."""
    inside = last - first - 1
    begin = np.cumsum(inside) - inside
    segment = np.repeat(np.arange(len(first)), inside)
    row = np.arange(len(segment)) - begin[segment] + first[segment] + 1
    found = off(first[segment], row, last[segment])
    most = np.maximum.reduceat(found, begin)
    return np.minimum.reduceat(np.where(found == most[segment], row, last[segment]), begin), most


def off_values(values: Array, at: Array, allowed: Array) -> Off:
    """Make a function that returns the deviations of values from linear interpolation, as multiples of the tolerance.
    Each row has a value, a time in `at` and a tolerance in `allowed`; all three arrays have shape (n,).
    """

    def off(first: Rows, row: Rows, last: Rows) -> Array:
        share = (at[row] - at[first]) / (at[last] - at[first])
        there = values[first] + share * (values[last] - values[first])
        return np.asarray(np.abs(there - values[row]) / allowed[row])

    return off


def off_poses(poses: Array, at: Array, *, place: float, turn: float) -> Off:
    """Make a function that returns the deviations of poses from interpolation, as multiples of the tolerances `place`
    (m) and `turn` (rad).

    `poses` has shape (n, 7): positions (m), then unit quaternions w, x, y, z, continuous in sign. `at` gives, for each
    row, the time or another quantity along which the poses are interpolated.
    """

    def off(first: Rows, row: Rows, last: Rows) -> Array:
        share = (at[row] - at[first]) / (at[last] - at[first])
        there = poses[first]
        there += share[:, None] * (poses[last] - there)
        size = np.sqrt(np.einsum("ij,ij->i", there[:, 3:], there[:, 3:]))
        there[:, 3:] /= np.maximum(size, _LEAST)[:, None]
        there -= poses[row]
        there *= there
        away, turned = there[:, :3].sum(axis=1), 4 * there[:, 3:].sum(axis=1)
        return np.asarray(np.sqrt(np.maximum(away / place**2, turned / turn**2)))

    return off


def smooth(poses: NDArray[np.floating]) -> Array:
    """Return poses, shape (n, 7), in which the signs of the quaternions are continuous from row to row."""
    turned = np.einsum("ij,ij->i", poses[1:, 3:], poses[:-1, 3:]) < 0
    alike = np.array(poses, dtype=np.float64)
    alike[1:, 3:] *= np.cumprod(np.where(turned, -1.0, 1.0))[:, None]
    return alike
