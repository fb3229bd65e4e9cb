"""The servo periods of a run that are enough to show it: the others lie nearly on the straight way between them."""

from collections.abc import Iterator
from math import radians
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.polyline import Off, Rows, needed_rows, off_poses, off_values, smooth
from handeye.core.pose import Array
from handeye.program.guards import GuardKind
from handeye.trace.forces import Forces
from handeye.trace.messages import Poses
from handeye.trace.trace import Trace

PLACE: Final = 2e-3
"""How far a body may be off where it was, m."""
TURN: Final = radians(1)
"""How far it may be turned, rad."""
FELT: Final = {
    GuardKind.FORCE: 1.0,
    GuardKind.AGAINST: 1.0,
    GuardKind.MOMENT: 0.04,
    GuardKind.TORQUE: 0.04,
    GuardKind.TOUCH: 0.5,
}
"""How far what a guard looks at may be off what it was: N, N m, or switches."""
APART: Final = 10.0
"""How far two periods may be apart, s, whatever stands still: the second hand of a clock goes on."""
_NOWHERE: Final = np.array([0, 0, -1e3, 1, 0, 0, 0], dtype=np.float64)
"""Where a body is that is not there: far from where any is."""


def kept_periods(trace: Trace) -> Rows:
    """The servo periods that are enough, by their numbers, in order: of a run that has any.

    Those in which a guard begins and ceases to watch are among them, and that in which what it looks at is greatest.
    """
    times, forces = trace.times, trace.forces()
    offs = [*_bodies(times, trace.poses), _felt(times, forces)]

    def off(first: Rows, row: Rows, last: Rows) -> Array:
        found: Array = np.maximum.reduce([each(first, row, last) for each in offs])
        return found

    now_and_then = np.searchsorted(times, np.arange(times[0], times[-1], APART))
    return needed_rows(off, np.unique([*now_and_then, len(times) - 1, *_watching(forces)]))


def _bodies(times: Array, poses: dict[str, Poses]) -> Iterator[Off]:
    """How far each body that moves is off."""
    for recorded in poses.values():
        there = np.where(np.isnan(recorded), _NOWHERE, recorded)
        if (there != there[0]).any():
            yield off_poses(smooth(there), times, place=PLACE, turn=TURN)


def _felt(times: Array, forces: Forces) -> Off:
    """How far what guards look at is off."""
    allowed: NDArray[np.float64] = np.full(len(times), np.inf)
    for kind, most in FELT.items():
        allowed[forces.guard == kind] = most
    return off_values(np.nan_to_num(forces.value), times, allowed)


def _watching(forces: Forces) -> Iterator[int]:
    """The first and the last servo period of each guarded motion, and that in which most was felt."""
    watched = np.concatenate([[False], forces.guard != "", [False]])
    borders = np.flatnonzero(watched[1:] != watched[:-1]).reshape(-1, 2).tolist()
    for first, after in borders:
        values = np.nan_to_num(forces.value[first:after], nan=-np.inf)
        yield from (first, first + int(values.argmax()), after - 1)
