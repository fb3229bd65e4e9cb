"""Thins traces: keeps only the servo periods that are needed to show the run. The omitted periods can be interpolated
linearly from the periods that are kept.
"""

from collections.abc import Iterator
from math import radians
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.errors import Refused
from handeye.core.polyline import Off, Rows, needed_rows, off_poses, off_values, smooth
from handeye.core.pose import Array
from handeye.program.event_reading import EventReader
from handeye.program.guards import GuardKind
from handeye.trace.channels import EVENTS, FRAMES, HAND, JOINTS, MACHINES, SCENE
from handeye.trace.forces import Forces
from handeye.trace.mcap_writer import GrowingFile
from handeye.trace.messages import FramesMessage, Poses
from handeye.trace.records import RawMessage
from handeye.trace.trace import Trace
from handeye.trace.writing import BOUNDARIES

PLACE_M: Final = 2e-3  # allowed deviation of a body
TURN_RAD: Final = radians(1)
FELT: Final = {
    GuardKind.FORCE: 1.0,
    GuardKind.AGAINST: 1.0,
    GuardKind.MOMENT: 0.04,
    GuardKind.TORQUE: 0.04,
    GuardKind.TOUCH: 0.5,
}  # allowed deviation of the reading of a guard: N, N m, or switches
LONGEST_GAP_S: Final = 10.0  # between two periods, even at rest: the second hand of a clock moves on
_NOWHERE: Final = np.array([0, 0, -1e3, 1, 0, 0, 0], dtype=np.float64)
"""Pose that an absent body gets: a place far from all other bodies."""


def kept_periods(trace: Trace) -> Rows:
    """Return the numbers of the servo periods to keep, in ascending order. The run must have at least one period.

    The first and last period of each guarded motion, and the period with the guard's greatest value, are always
    kept.
    """
    times, forces = trace.times, trace.forces()
    offs = [*_bodies(times, trace.poses), _felt(times, forces)]

    def off(first: Rows, row: Rows, last: Rows) -> Array:
        found: Array = np.maximum.reduce([each(first, row, last) for each in offs])
        return found

    now_and_then = np.searchsorted(times, np.arange(times[0], times[-1], LONGEST_GAP_S))
    return needed_rows(off, np.unique([*now_and_then, len(times) - 1, *_watching(forces)]))


def _bodies(times: Array, poses: dict[str, Poses]) -> Iterator[Off]:
    for recorded in poses.values():
        there = np.where(np.isnan(recorded), _NOWHERE, recorded)
        if (there != there[0]).any():
            yield off_poses(smooth(there), times, place=PLACE_M, turn=TURN_RAD)


def _felt(times: Array, forces: Forces) -> Off:
    """Return a function that computes how far the guards' values deviate from linear interpolation."""
    allowed: NDArray[np.float64] = np.full(len(times), np.inf)
    for kind, most in FELT.items():
        allowed[forces.guard == kind] = most
    return off_values(np.nan_to_num(forces.value), times, allowed)


def _watching(forces: Forces) -> Iterator[int]:
    """Yield the first and last servo period of each guarded motion, and the period with the guard's greatest
    value."""
    watched = np.concatenate([[False], forces.guard != "", [False]])
    borders = np.flatnonzero(watched[1:] != watched[:-1]).reshape(-1, 2).tolist()
    for first, after in borders:
        values = np.nan_to_num(forces.value[first:after], nan=-np.inf)
        yield from (first, first + int(values.argmax()), after - 1)


STEP: Final = np.float32(2.0**-13)
"""Positions (m) and components of quaternions are rounded to multiples of this step. For positions, the step is an
eighth of a millimetre. For rotations, one step means a turn of at most .014 degrees.
"""


def write_thinned(trace: Trace, path: Path) -> int:
    """Write a thinned trace of a run. Returns the number of servo periods in the thinned trace.

    The thinned trace lacks the joints, hand and frames of the periods that are not kept. It also lacks the shapes of
    the bodies, because only other programs use these shapes. Frames are rounded. Everything else is unchanged, byte
    for byte. Raises Refused if the trace is already thinned or contains no motion.
    """
    if trace.thinned:
        raise Refused(f"{trace.name} is already thinned")
    if not len(trace.times):
        raise Refused(f"{trace.name} contains no motion to thin")
    kept = kept_periods(trace)
    file = GrowingFile(path.with_name(f".{path.name}.new"))
    try:
        file.begin(trace.head, trace.plan, thinned=True)
        reader = EventReader(trace.head.system)
        for message in _messages(trace, frozenset(kept.tolist())):
            event = reader.read(message.data) if message.topic == EVENTS else None
            file.write(message.topic, message.time, message.data, boundary=isinstance(event, BOUNDARIES))
        file.finish()
        file.move(path)
    except BaseException:
        file.file.unlink(missing_ok=True)
        raise
    finally:
        file.release()
    return len(kept)


def _messages(trace: Trace, kept: frozenset[int]) -> Iterator[RawMessage]:
    """Yield the messages of the thinned trace. In a kept period, the poses follow the message about the joints."""
    frames, row = _Frames(trace), -1
    for message in trace.messages:
        row += message.topic == JOINTS
        if message.topic in (FRAMES, SCENE) or (
            message.topic in (JOINTS, HAND, MACHINES) and row not in kept
        ):
            continue
        yield message
        if message.topic == JOINTS:
            yield from frames.moved(row, message.time)


class _Frames:
    """Converts poses to messages about those bodies that have moved since the last message."""

    def __init__(self, trace: Trace) -> None:
        self._poses = np.rint(np.stack(list(trace.poses.values()), axis=1) / STEP) * STEP
        self._message = FramesMessage(tuple(trace.poses))
        self._told = np.full_like(self._poses[0], np.nan)

    def moved(self, row: int, time: int) -> Iterator[RawMessage]:
        """Yield the message for a servo period, if any body has moved."""
        now = self._poses[row]
        which = np.flatnonzero(~np.isnan(now[:, 0]) & (now != self._told).any(axis=1))
        if which.size:
            self._told[which] = now[which]
            yield RawMessage(FRAMES, time, self._message.filled(time, which.tolist(), now[which].tolist()))
