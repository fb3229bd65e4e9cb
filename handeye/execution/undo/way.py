"""The path of a step: set-points of joints and fingers, one per servo period.

On disk, the path is stored in whole millionths of a radian or metre, because the second differences of whole
numbers compress to less than a byte each.
"""

import math
import zlib
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.core.pose import Array

GRAIN: Final = 1e-6  # rad or m; at the hand a tenth of the potentiometers' resolution
_LONGEST: Final = 1 << 22  # decompressed bytes: enough for days


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RecordedPath:
    """Set-points from the start of a step to its end."""

    q: Array  # (N, n), in rad and m
    gap: Array  # (N,), in m

    def __len__(self) -> int:
        return len(self.gap)


@dataclass(slots=True)
class Track:
    """Records the set-points of a step, and the greatest force during the step."""

    force: float = 0.0  # greatest so far, in N
    _q: list[Array] = field(default_factory=list)
    _gap: list[float] = field(default_factory=list)

    def begin(self, q: Array, gap: float) -> None:
        """Start recording from the present set-points."""
        self.force, self._q, self._gap = 0.0, [q], [gap]

    def note(self, q: Array, gap: float) -> None:
        """Record the set-points of one servo period."""
        self._q.append(q)
        self._gap.append(gap)

    def felt(self, wrench: Array) -> None:
        """Record the wrench on the hand, shape (6,)."""
        force = wrench[:3]
        self.force = max(self.force, math.sqrt(force.dot(force)))

    def way(self, q: Array, gap: float) -> RecordedPath | None:
        """Return the recorded path, which ends at the given set-points. Returns None if neither the arm nor the
        fingers moved.
        """
        way = RecordedPath(q=np.array([*self._q, q]), gap=np.array([*self._gap, gap]))
        rows = _rows(way)
        moved = np.flatnonzero((rows[1:] != rows[:-1]).any(axis=1))
        if not len(moved):
            return None
        part = slice(int(moved[0]), int(moved[-1]) + 2)  # without the periods at rest before and after
        return RecordedPath(q=way.q[part], gap=way.gap[part])


def packed(way: RecordedPath) -> bytes:
    """Encode a path as bytes, rounded to `GRAIN`."""
    first = np.diff(_rows(way), axis=0, prepend=np.int32(0))
    return zlib.compress(np.diff(first, axis=0, prepend=np.int32(0)).T.tobytes(), 6)


def unpacked(data: bytes, joints: int) -> RecordedPath:
    """Decode a path from bytes made by `packed`. Raises ValueError if the path does not belong to an arm with `joints`
    joints.
    """
    inflater = zlib.decompressobj()
    try:
        inflated = inflater.decompress(data, _LONGEST)
    except zlib.error as error:
        raise ValueError(f"the record does not contain a valid path: {error}") from None
    numbers = np.frombuffer(inflated, "<i4") if len(inflated) % 4 == 0 else np.empty(0)
    if not inflater.eof or not len(numbers) or len(numbers) % (joints + 1):
        raise ValueError("the record does not contain a path of this arm")
    second = numbers.reshape(joints + 1, -1).T
    whole = np.cumsum(np.cumsum(second.astype(np.int64), axis=0), axis=0)
    rows: Array = np.asarray(whole * GRAIN, dtype=np.float64)
    return RecordedPath(q=rows[:, :-1], gap=rows[:, -1])


def _rows(way: RecordedPath) -> np.ndarray[tuple[int, ...], np.dtype[np.int32]]:
    """Return the joint positions and the gap in units of `GRAIN`, shape (N, n + 1)."""
    return np.rint(np.column_stack([way.q, way.gap]) / GRAIN).astype("<i4")
