"""What a page needs to show where every body was: their tracks, and the clock."""

from collections.abc import Iterable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.pose import Array
from handeye.report.player.packing import columns, packed, quantised, rounded, zigzag
from handeye.report.player.track import Track
from handeye.trace.messages import Poses

UNIT: Final = 0x1FFF
"""What 1 is in a quaternion: it turns by .01 degrees at most when it is rounded. The script knows it too."""


def tracks_bytes(
    poses: Mapping[str, Poses], *, times: Array, begin: float, end: float, lowest: float
) -> bytes:
    """Tracks and clock, compressed.

    Args:
        poses: of bodies in all servo periods, shape (n, 7); NaN where one is not there.
        times: ends of the servo periods since the run began, shape (n,), s.
        begin: from when on the page shows the run, s.
        end: until when.
        lowest: height below which a body is put away, m.
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
    """Rows of arrays, shape (n, width); none of no arrays."""
    return np.concatenate([np.empty((0, width)), *arrays])
