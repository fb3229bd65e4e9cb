"""Chooses the frames to write: those that have moved since they were last written, or were never written."""

from itertools import pairwise
from typing import Final

import numpy as np

from handeye.trace.frames import Mask
from handeye.trace.messages import Poses

MOVED: Final = 1e-6  # least change of a pose that is written: m, or of a quaternion component
PUT_AWAY: Final = (
    -1.0
)  # height (m), below the floor; a lower part is hidden there, because another body represents it

Figures = list[list[float]]
"""Poses, seven figures each."""


class MovedFrames:
    """The poses of `n` frames as last written."""

    def __init__(self, n: int) -> None:
        self.written: Poses = np.full((n, 7), np.nan, dtype=np.float32)  # NaN: never

    def to_write(self, poses: Poses, there: Mask, *, anew: bool = False) -> list[tuple[list[int], Figures]]:
        """Return the numbers and poses of the frames to write at each of `m` times. If `anew` is True, all frames are
        written. `poses`, shape (m, n, 7), is changed in place; `there` has shape (m, n).

        Bodies that are put away are written only if `anew` is True, because the poses of such bodies do not matter. A
        body that has ceased to exist, such as the carrier of a screw that was turned out, counts as put away.

        Each pose is compared with the last pose that was written. Which pose was written last depends on earlier
        comparisons. Therefore the comparisons are made in rounds. The first round assumes that nothing was written.
        Each further round assumes that exactly the rows chosen by the previous round were written. The last round is
        the one that chooses the same rows as the round before it. Each round settles at least one of the `m` times.
        Frames that rest, or that move all the time, need at most three rounds.
        """
        poses[~there, 2] = 2 * PUT_AWAY
        rows = np.concatenate([self.written[None], poses])
        times = np.arange(1, len(rows))[:, None]
        last = np.zeros(rows.shape[:2], dtype=np.intp)  # the row last written up to each row
        some = np.arange(rows.shape[1])  # frames that are not settled
        while some.size:
            now, sent = rows[1:, some], rows[last[:-1, some], some]
            moved = (np.abs(now - sent) > MOVED).any(axis=2)  # false for what was never written
            away = (now[..., 2] < PUT_AWAY) & (sent[..., 2] < PUT_AWAY)
            chosen = (moved & ~away) | (there[:, some] & (anew | np.isnan(sent[..., 2])))
            found = np.maximum.accumulate(np.where(chosen, times, 0))
            changed = (found != last[1:, some]).any(axis=0)
            last[1:, some] = found
            some = some[changed]
        self.written = rows[last[-1], np.arange(rows.shape[1])]
        chosen = last[1:] == times
        numbers, figures = np.nonzero(chosen)[1].tolist(), poses[chosen].tolist()
        ends = chosen.sum(axis=1).cumsum().tolist()
        return [(numbers[first:end], figures[first:end]) for first, end in pairwise([0, *ends])]
