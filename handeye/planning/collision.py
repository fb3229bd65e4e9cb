"""Obstacles of the hand, and of what it holds, on a planned motion: the fixtures of the program, and the table.

All are boxes. A motion may begin inside something, for a guarded one before it is planned to go on where in truth it
stops; then it may come out, by half the margin at least, and what counts is what it goes into afterwards. Where a goal
is judged, the end of the motion counts in any case.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.obb import Box, depths, lowest
from handeye.core.pose import Array, Pose, inverse, planar
from handeye.core.units import INCH
from handeye.program.program import Program

MARGIN: Final = 0.1 * INCH
"""Overlap of boxes that is not reported. The free motions of the pump swing by as much beside the straight way down:
where the screwdriver comes back, it is planned .02 in into its rack."""

SAME: Final = 1e-6
"""Difference of depths that is none, m: of the same depth before and behind the middle of a box the first counts, on
every processor."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Crossing:
    """A collision on a motion."""

    what: str | None
    """The fixture; None: the table."""
    depth: float
    """How deep at most, m."""
    along: float
    """How far the hand has gone when it is deepest, m."""
    at_end: bool
    """It is deepest at the end of the motion."""


class Surroundings:
    """The fixtures of a program, box by box."""

    def __init__(self, program: Program) -> None:
        fixtures = [
            (name, fixture, box) for name, fixture in program.fixtures.items() for box in fixture.boxes
        ]
        self._names = [name for name, _, _ in fixtures]
        self._boxes = [box for _, _, box in fixtures]
        frames = [inverse(planar(*fixture.at)) for _, fixture, _ in fixtures]
        self._X_FW = np.array(frames).reshape(-1, 4, 4)

    def crossing(self, X_WT: Pose, boxes: Sequence[Box], *, goal: bool) -> Crossing | None:
        """The deepest that boxes in T come into a fixture over poses of shape (N, 4, 4)."""
        if not self._boxes or not boxes:
            return None
        deep = depths(self._X_FW @ X_WT[:, None], boxes, self._boxes)
        return _deepest(X_WT, deep.reshape(len(X_WT), -1), self._names * len(boxes), goal)


def table_crossing(X_WT: Pose, boxes: Sequence[Box], *, goal: bool) -> Crossing | None:
    """The deepest that boxes in T come below the table over poses of shape (N, 4, 4)."""
    if not boxes:
        return None
    deep = np.maximum(-lowest(X_WT, boxes), 0.0)
    return _deepest(X_WT, deep, [None] * len(boxes), goal)


def _deepest(X_WT: Pose, deep: Array, names: Sequence[str | None], goal: bool) -> Crossing | None:
    """The worst of depths of shape (N, k), those left out with which the motion begins."""
    outside = np.logical_or.accumulate(deep <= MARGIN / 2, axis=0)
    outside[-1] |= goal
    entered = np.where(outside & (deep > MARGIN), deep, 0.0)
    sample, which = divmod(int(np.argmax(entered >= entered.max() - SAME)), entered.shape[1])
    if entered[sample, which] == 0.0:
        return None
    way = np.linalg.norm(np.diff(X_WT[: sample + 1, :3, 3], axis=0), axis=1)
    return Crossing(
        what=names[which], depth=float(entered[sample, which]), along=float(way.sum()),
        at_end=bool(deep[-1, which] >= entered[sample, which] - MARGIN),
    )  # fmt: skip
