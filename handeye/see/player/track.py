"""The track of a body in a run: as few poses as tell where it was all the time."""

from dataclasses import dataclass
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray

from handeye.pose import Array

PLACE: Final = 1.5e-4
"""How far a body may be from where it was, m, before numbers are rounded."""
TURN: Final = 2e-3
"""How far it may be turned, rad."""
_STILL: Final = 1e-6
"""What is no movement: m, and parts of a quaternion."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Track:
    """Some poses of a body; where it was in between lies on the straight way from one to the next."""

    spans: tuple[tuple[int, int, int], ...]
    """Servo periods from which and to which (exclusive) it is there, and how many of the poses are of them."""
    periods: NDArray[np.int64]
    """Servo periods of the poses, shape (n,)."""
    poses: Array
    """Shape (n, 7): place (m), then a unit quaternion w, x, y, z, each as near to the one before as it can be."""

    @classmethod
    def of(cls, poses: NDArray[np.floating[Any]], lowest: float) -> Self | None:
        """The track of a body from its poses in all servo periods, shape (m, 7); None if it is never there.

        Args:
            lowest: height below which a body is put away and not there, m. NaN is not there either.
        """
        there = poses[:, 2] >= lowest
        edges = np.flatnonzero(np.diff(there, prepend=False, append=False)).reshape(-1, 2).tolist()
        if not edges:
            return None
        smooth = [_alike(poses[first:after]) for first, after in edges]
        kept = [_needed(part) for part in smooth]
        return cls(
            spans=tuple((first, after, len(rows)) for (first, after), rows in zip(edges, kept, strict=True)),
            periods=np.concatenate([first + rows for (first, _), rows in zip(edges, kept, strict=True)]),
            poses=np.concatenate([part[rows] for part, rows in zip(smooth, kept, strict=True)]),
        )

    def still(self, count: int) -> bool:
        """It is there in all of so many servo periods, and nothing moves it."""
        return self.spans == ((0, count, 1),)


def _alike(poses: NDArray[np.floating[Any]]) -> Array:
    """The same poses, the quaternion of each the nearer of its two to the one before."""
    turned = np.einsum("ij,ij->i", poses[1:, 3:], poses[:-1, 3:]) < 0
    sign = np.cumprod(np.where(turned, -1.0, 1.0), dtype=float)
    alike = np.array(poses, dtype=float)
    alike[1:, 3:] *= sign[:, None]
    return alike


def _needed(poses: Array) -> NDArray[np.int64]:
    """The rows between which all others lie near enough.

    A way that leaves one too far off is cut where it is farthest off, from the whole way on; all ways at once.
    """
    if np.ptp(poses, axis=0).max() < _STILL:
        return np.zeros(1, dtype=np.int64)
    kept = np.zeros(len(poses), dtype=bool)
    first, last = np.array([0]), np.array([len(poses) - 1])
    kept[[0, -1]] = True
    while (last - first > 1).any():
        worst, off = _worst(poses, first, last)
        cut = off > 1
        kept[worst[cut]] = True
        first, last = np.append(first[cut], worst[cut]), np.append(worst[cut], last[cut])
        long = last - first > 1
        first, last = first[long], last[long]
    return np.flatnonzero(kept)


def _worst(
    poses: Array, first: NDArray[np.int64], last: NDArray[np.int64]
) -> tuple[NDArray[np.int64], Array]:
    """For each way from a first to a last row the row between that is farthest off, and how far: see `_off`."""
    inside = last - first - 1
    begin = np.cumsum(inside) - inside
    way = np.repeat(np.arange(len(first)), inside)
    row = np.arange(len(way)) - begin[way] + first[way] + 1
    off = _off(poses, first[way], row, last[way])
    top = np.maximum.reduceat(off, begin)
    return np.minimum.reduceat(np.where(off == top[way], row, len(poses)), begin), top


def _off(poses: Array, first: NDArray[np.int64], row: NDArray[np.int64], last: NDArray[np.int64]) -> Array:
    """How far rows are off the straight ways from first to last ones, over what is allowed; shape (n,)."""
    share = (row - first) / (last - first)
    there = poses[first]
    there += share[:, None] * (poses[last] - there)
    size = np.sqrt(np.einsum("ij,ij->i", there[:, 3:], there[:, 3:]))
    there[:, 3:] /= size[:, None]
    there -= poses[row]
    there *= there
    place, turn = there[:, :3].sum(axis=1), 4 * there[:, 3:].sum(axis=1)
    return np.asarray(np.sqrt(np.maximum(place / PLACE**2, turn / TURN**2)))
