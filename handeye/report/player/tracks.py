"""Prepares the data that show the motion of all bodies on a page: tracks, and the run's clock."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray

from handeye.core.polyline import Rows, needed_rows, off_poses, smooth
from handeye.core.pose import Array
from handeye.report.player.packing import columns, packed, quantised, rounded, zigzag
from handeye.trace.messages import Poses

PLACE: Final = 1.5e-4  # Tolerance of an interpolated position, m, before numbers are rounded
TURN: Final = 2e-3  # Tolerance of an interpolated rotation, rad
_STILL: Final = 1e-6  # Changes too small to be movement: m, and components of a quaternion


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Track:
    """Selected poses of a body. All other poses are interpolated linearly between the selected poses."""

    spans: tuple[tuple[int, int, int], ...]
    """Spans in which the body is present. Each span contains three numbers: its first servo period, the first period
    after the span, and the number of poses in the span.
    """
    periods: NDArray[np.int64]  # Servo periods of the poses, shape (n,)
    poses: Array
    """Poses, shape (n, 7): position (m), then a unit quaternion w, x, y, z. Two quaternions with opposite signs
    describe the same rotation. Each pose contains whichever of the two is nearer to the quaternion of the previous
    pose.
    """

    @classmethod
    def of(cls, poses: NDArray[np.floating[Any]], lowest: float) -> Self | None:
        """Make the track of a body from its poses in all servo periods, shape (m, 7). Returns None if the body
        is always hidden.

        Args:
            lowest: height (m) below which a body is hidden. A pose of NaN also means that the body is hidden.
        """
        there = poses[:, 2] >= lowest
        edges = np.flatnonzero(np.diff(there, prepend=False, append=False)).reshape(-1, 2).tolist()
        if not edges:
            return None
        parts = [smooth(poses[first:after]) for first, after in edges]
        kept = [_needed(part) for part in parts]
        return cls(
            spans=tuple((first, after, len(rows)) for (first, after), rows in zip(edges, kept, strict=True)),
            periods=np.concatenate([first + rows for (first, _), rows in zip(edges, kept, strict=True)]),
            poses=np.concatenate([part[rows] for part, rows in zip(parts, kept, strict=True)]),
        )

    def still(self, count: int) -> bool:
        """Return True if the body is present in all `count` servo periods and never moves."""
        return self.spans == ((0, count, 1),)


def _needed(poses: Array) -> Rows:
    """Return the rows of `poses` from which all other rows can be interpolated within tolerance."""
    if np.ptp(poses, axis=0).max() < _STILL:
        return np.zeros(1, dtype=np.int64)
    numbers = np.arange(len(poses), dtype=np.float64)
    return needed_rows(off_poses(poses, numbers, place=PLACE, turn=TURN), [0, len(poses) - 1])


UNIT: Final = 0x1FFF
"""The whole number that stores a quaternion component of 1. Rounding turns a body by at most .01 degrees. The player's
script has the same constant.
"""


def tracks_bytes(
    poses: Mapping[str, Poses], *, times: Array, begin: float, end: float, lowest: float
) -> bytes:
    """Return tracks and clock, compressed.

    Args:
        poses: poses of the bodies in all servo periods, shape (n, 7) each; NaN while a body is hidden.
        times: times at the end of each servo period, shape (n,), in seconds since the run began. `begin` and
            `end`, the range of the page, are also in seconds since the run began.
        lowest: height (m) below which a body is hidden.
    """
    found = {name: Track.of(rows, lowest) for name, rows in poses.items()}
    tracks = {name: track for name, track in found.items() if track is not None}
    still = {name: rounded(track.poses[0]) for name, track in tracks.items() if track.still(len(times))}
    moving = {name: track for name, track in tracks.items() if name not in still}
    places = [quantised(track.poses[:, :3]) for track in moving.values()]
    told = [
        {"body": name, "spans": track.spans, "scale": scale}
        for (name, track), (_, scale) in zip(moving.items(), places, strict=True)
    ]
    arrays: dict[str, NDArray[Any]] = {
        "clock": np.diff(np.rint(times * 1e6).astype(np.int64), prepend=0).astype(np.int32),
        "periods": zigzag(_joined(track.periods[:, None] for track in moving.values()).ravel()),
        "places": columns(_joined((numbers for numbers, _ in places), 3)),
        "turns": columns(np.rint(UNIT * _joined((track.poses[:, 3:] for track in moving.values()), 4))),
    }
    return packed({"begin": round(begin, 6), "end": round(end, 6), "still": still, "moving": told}, arrays)


def _joined(arrays: Iterable[NDArray[Any]], width: int = 1) -> NDArray[Any]:
    """Concatenate the rows of arrays, shape (n, width). The result is empty if there are no arrays."""
    return np.concatenate([np.empty((0, width)), *arrays])
