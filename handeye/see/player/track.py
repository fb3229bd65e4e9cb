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

    A way that leaves one too far off is cut where it is farthest off, from the whole way on.
    """
    if np.ptp(poses, axis=0).max() < _STILL:
        return np.zeros(1, dtype=np.int64)
    kept, ways = {0, len(poses) - 1}, [(0, len(poses) - 1)]
    while ways:
        first, last = ways.pop()
        if last - first < 2:
            continue
        off = _off(poses[first : last + 1])
        worst = first + int(off.argmax())
        if off.max() > 1:
            kept.add(worst)
            ways += [(first, worst), (worst, last)]
    return np.array(sorted(kept))


def _off(poses: Array) -> Array:
    """How far poses are off the straight way from the first to the last, over what is allowed; shape (n,)."""
    way = poses[0] + np.linspace(0, 1, len(poses))[:, None] * (poses[-1] - poses[0])
    way[:, 3:] /= np.sqrt(np.einsum("ij,ij->i", way[:, 3:], way[:, 3:]))[:, None]
    square = (way - poses) ** 2
    place, turn = square[:, :3].sum(axis=1), 4 * square[:, 3:].sum(axis=1)
    return np.asarray(np.sqrt(np.maximum(place / PLACE**2, turn / TURN**2)))
