"""Writes a trace anew with as few of its servo periods as it takes to show the run."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

import numpy as np

from handeye.core.errors import Refused
from handeye.program.event_reading import EventReader
from handeye.trace.channels import EVENTS, FRAMES, HAND, JOINTS, SCENE
from handeye.trace.mcap_writer import GrowingFile
from handeye.trace.messages import FramesMessage
from handeye.trace.records import RawMessage
from handeye.trace.thinning import kept_periods
from handeye.trace.trace import Trace
from handeye.trace.writing import BOUNDARIES

STEP: Final = np.float32(2.0**-13)
"""To which places (m) and parts of quaternions are rounded: an eighth of a millimetre, and .014 degrees at most."""


def write_thinned(trace: Trace, path: Path) -> int:
    """Write a thinned trace of a run; the number of servo periods that it keeps.

    Left out are joints, hand and frames of the other periods, and the looks of the bodies, which other programs show.
    Frames are rounded. All else is as it was, to the byte.

    Raises:
        InvalidInput: it is thinned already, it holds no motion, or it cannot be written.
    """
    _check(trace)
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


def _check(trace: Trace) -> None:
    if trace.thinned:
        raise Refused(f"{trace.name} is thinned already")
    if not len(trace.times):
        raise Refused(f"{trace.name} holds no motion to be thinned")


def _messages(trace: Trace, kept: frozenset[int]) -> Iterator[RawMessage]:
    """The messages of the thinned trace. Where everything was stands behind the joints of a period that is kept."""
    frames, row = _Frames(trace), -1
    for message in trace.messages:
        row += message.topic == JOINTS
        if message.topic in (FRAMES, SCENE) or (message.topic in (JOINTS, HAND) and row not in kept):
            continue
        yield message
        if message.topic == JOINTS:
            yield from frames.moved(row, message.time)


class _Frames:
    """Where bodies were, as messages that tell of those that have moved since they were told of last."""

    def __init__(self, trace: Trace) -> None:
        self._poses = np.rint(np.stack(list(trace.poses.values()), axis=1) / STEP) * STEP
        self._message = FramesMessage(tuple(trace.poses))
        self._told = np.full_like(self._poses[0], np.nan)

    def moved(self, row: int, time: int) -> Iterator[RawMessage]:
        """The message for a servo period; none if nothing has moved."""
        now = self._poses[row]
        which = np.flatnonzero(~np.isnan(now[:, 0]) & (now != self._told).any(axis=1))
        if which.size:
            self._told[which] = now[which]
            yield RawMessage(FRAMES, time, self._message.filled(time, which.tolist(), now[which]))
