"""A recorded run at any time, without simulating it again."""

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

from handeye.core.pose import Array
from handeye.program.events import AnyEvent, StageFinished, StageStarted, StepStarted
from handeye.trace.channels import FRAMES, JOINTS
from handeye.trace.messages import Poses
from handeye.trace.motion import Motion
from handeye.trace.pictures import TakenPicture
from handeye.trace.records import RawMessage

Pose7 = tuple[float, float, float, float, float, float, float]
"""Place of a frame in W (m) and its unit quaternion w, x, y, z."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Moment:
    """A moment of a run."""

    time: float
    """Of the servo period that is shown, s."""
    joints: Array
    """Positions by the sensors, shape (m,), rad and m."""
    gap: float
    """m"""
    poses: dict[str, Pose7]
    """Frames in W: place (m), then a unit quaternion w, x, y, z."""
    stage: str | None
    """None between two stages."""
    step: StepStarted | None
    """The step under way, or done last: its line and text."""
    picture: TakenPicture | None
    """The last one taken."""


@dataclass(frozen=True, slots=True)
class _Telling:
    """Stage and step from a time on."""

    time: float
    stage: str | None
    step: StepStarted | None


class Replay:
    """A run made ready to be looked at from any time to any other; it has one servo period at least."""

    def __init__(
        self,
        motion: Motion,
        messages: Iterable[RawMessage],
        events: Iterable[AnyEvent],
        pictures: Sequence[TakenPicture],
    ) -> None:
        """Gather where everything was in each servo period.

        Raises:
            DecodeError: a message about frames is none.
        """
        self._motion, self._pictures = motion, pictures
        self._told = _tellings(events)
        self.names, self.poses = _placed(moves(messages), len(motion.times))

    def seek(self, time: float) -> Moment:
        """The moment at a time (s); before the first servo period as at the first, after the last as at the last."""
        row = max(bisect_right(self._motion.times, time) - 1, 0)
        told = bisect_right(self._told, time, key=lambda telling: telling.time) - 1
        taken = bisect_right(self._pictures, time, key=lambda picture: picture.time) - 1
        return Moment(
            time=float(self._motion.times[row]),
            joints=self._motion.joints[row],
            gap=float(self._motion.gaps[row]),
            poses=dict(self._there(row)),
            stage=self._told[told].stage if told >= 0 else None,
            step=self._told[told].step if told >= 0 else None,
            picture=self._pictures[taken] if taken >= 0 else None,
        )

    def _there(self, row: int) -> Iterable[tuple[str, Pose7]]:
        """The frames that there are in a servo period."""
        for name, pose in zip(self.names, self.poses[row].tolist(), strict=True):
            x, y, z, qw, qx, qy, qz = pose
            if x == x:  # not NaN
                yield name, (x, y, z, qw, qx, qy, qz)


def moves(messages: Iterable[RawMessage]) -> Iterable[tuple[int, dict[str, Pose7]]]:
    """Frames as they were written: the number of the servo period they are of, and the pose of each.

    Those before the first servo period come with it.

    Raises:
        DecodeError: a message about frames is none.
    """
    row = -1
    for message in messages:
        if message.topic == JOINTS:
            row += 1
        elif message.topic == FRAMES:
            yield max(row, 0), _poses(message.data)


def _poses(data: bytes) -> dict[str, Pose7]:
    found: dict[str, Pose7] = {}
    for frame in FrameTransforms.FromString(data).transforms:
        p, r = frame.translation, frame.rotation
        found[frame.child_frame_id] = (p.x, p.y, p.z, r.w, r.x, r.y, r.z)
    return found


def _placed(moved: Iterable[tuple[int, dict[str, Pose7]]], rows: int) -> tuple[tuple[str, ...], Poses]:
    """Names of the frames, and their poses in each servo period, shape (rows, frames, 7); NaN before one is seen."""
    written = list(moved)
    names = tuple(dict.fromkeys(name for _, poses in written for name in poses))
    index = {name: number for number, name in enumerate(names)}
    placed = np.full((rows, len(names), 7), np.nan, dtype=np.float32)
    known = 0
    for row, poses in written:
        if row > known:
            placed[known + 1 : row + 1] = placed[known]
            known = row
        placed[row, [index[name] for name in poses]] = list(poses.values())
    placed[known + 1 :] = placed[known]
    return names, placed


def _tellings(events: Iterable[AnyEvent]) -> list[_Telling]:
    told: list[_Telling] = []
    stage: str | None = None
    step: StepStarted | None = None
    for event in events:
        match event:
            case StageStarted():
                stage = event.stage
            case StageFinished():
                stage = None
            case StepStarted():
                step = event
            case _:
                continue
        told.append(_Telling(event.time, stage, step))
    return told
