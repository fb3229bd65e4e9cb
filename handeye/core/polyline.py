"""Rows of a recording that are enough: all others lie nearly on the straight ways between them."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array

_LEAST: Final = 1e-9
"""Halfway between a quaternion and its opposite, after a whole turn, is none: far off, and no division by zero."""

Rows = NDArray[np.int64]
Off = Callable[[Rows, Rows, Rows], Array]
"""Given ways by their first rows, a row on each, and their last rows: how far those rows are off, shape (n,), where 1
is what is allowed."""


def needed_rows(off: Off, always: Sequence[int] | Rows) -> Rows:
    """The rows between which all others lie near enough.

    A way that leaves a row too far off is cut where one is farthest off, from the ways between those that are kept
    always on; all ways at once.

    Args:
        always: rows that are kept, in order: the first and the last of all, and others.
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
    """For each way from a first to a last row the row between that is farthest off, and how far."""
    inside = last - first - 1
    begin = np.cumsum(inside) - inside
    way = np.repeat(np.arange(len(first)), inside)
    row = np.arange(len(way)) - begin[way] + first[way] + 1
    found = off(first[way], row, last[way])
    most = np.maximum.reduceat(found, begin)
    return np.minimum.reduceat(np.where(found == most[way], row, last[way]), begin), most


def off_values(values: Array, at: Array, allowed: Array) -> Off:
    """How far values are off, each over what is allowed of it; values, `at` and `allowed` have shape (n,)."""

    def off(first: Rows, row: Rows, last: Rows) -> Array:
        share = (at[row] - at[first]) / (at[last] - at[first])
        there = values[first] + share * (values[last] - values[first])
        return np.asarray(np.abs(there - values[row]) / allowed[row])

    return off


def off_poses(poses: Array, at: Array, *, place: float, turn: float) -> Off:
    """How far poses are off.

    Args:
        poses: place (m), then a unit quaternion w, x, y, z, as near to the one before as it can be, shape (n, 7).
        at: where the rows are on a way, shape (n,): their times, or numbers.
        place: what is allowed, m.
        turn: what is allowed, rad.
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
    """The same poses, shape (n, 7), the quaternion of each the nearer of its two to the one before."""
    turned = np.einsum("ij,ij->i", poses[1:, 3:], poses[:-1, 3:]) < 0
    alike = np.array(poses, dtype=np.float64)
    alike[1:, 3:] *= np.cumprod(np.where(turned, -1.0, 1.0))[:, None]
    return alike
