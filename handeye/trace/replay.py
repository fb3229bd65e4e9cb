"""Reconstructs the state of a recorded run at any time, without simulation: motions, pictures and poses."""

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.JointStates_pb2 import JointStates
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage

from handeye.core.brief import Brief, Named
from handeye.core.pose import Array
from handeye.ports.camera import Picture
from handeye.program.event_reading import EventReader
from handeye.program.events import AnyEvent, PictureTaken, StageFinished, StageStarted, StepStarted
from handeye.trace.channels import EVENTS, FRAMES, JOINTS, PICTURE
from handeye.trace.hand_message import decoded_channels
from handeye.trace.messages import GAP, LEVEL, Poses
from handeye.trace.records import RawMessage


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class TakenPicture(Brief):
    """A picture that the program took."""

    time: float  # s
    name: str
    picture: Picture  # levels 0 to 15, shape (rows, columns), uint8


def read_pictures(messages: Iterable[RawMessage]) -> Iterator[TakenPicture]:
    """Yield the pictures that the messages contain, in the same order. The event that follows a picture gives the
    picture's name.
    """
    picture: Picture | None = None
    reader = EventReader()
    for message in messages:
        if message.topic == PICTURE:
            picture = _levels(message.data)
        elif message.topic == EVENTS:
            event = reader.read(message.data)
            if isinstance(event, PictureTaken) and picture is not None:
                yield TakenPicture(time=event.time, name=event.picture, picture=picture)
                picture = None


def _levels(data: bytes) -> Picture:
    image = RawImage.FromString(data)
    grey = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width)
    return grey // np.uint8(LEVEL)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Motion(Brief):
    """The sensed motion of an arm's joints during a run, as arrays over n servo periods and m joints."""

    names: tuple[str, ...]  # names of the joints, in order
    times: Array  # ends of the servo periods, shape (n,), s
    joints: Array  # sensed positions, shape (n, m): rad, or m for prismatic joints
    rates: Array  # sensed rates, shape (n, m): rad/s, or m/s for prismatic joints
    efforts: (
        Array  # commanded torques, shape (n, m): N m, or N for prismatic joints; zero while the brakes are on
    )
    gaps: Array  # opening of the fingers, shape (n,), m


def read_motion(messages: Iterable[RawMessage]) -> Motion:
    """Make the arrays of a `Motion` from messages about joints. Raises ValueError if the messages describe more than
    one arm.
    """
    times, rows, names = [], [], None
    for message in messages:
        joints = JointStates.FromString(message.data).joints
        names = names or [joint.name for joint in joints]
        if [joint.name for joint in joints] != names:
            raise ValueError("the joints belong to another arm")
        times.append(message.time / 1e9)
        rows.append([(joint.position, joint.velocity, joint.effort) for joint in joints])
    names = names or [GAP]
    gap = names.index(GAP)
    columns = np.array(rows, dtype=np.float64).reshape(len(rows), len(names), 3)
    arm = np.delete(columns, gap, axis=1)
    return Motion(
        names=tuple(name for name in names if name != GAP),
        times=np.array(times),
        joints=arm[:, :, 0],
        rates=arm[:, :, 1],
        efforts=arm[:, :, 2],
        gaps=columns[:, gap, 0],
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class ChannelCurve(Brief):
    """One component of a channel over time."""

    name: str
    unit: str  # SI; empty: a switch or a count
    times: Array  # ends of the servo periods, shape (n,), s on the cell's clock
    values: Array  # (n,)


def read_channels(messages: Iterable[RawMessage]) -> tuple[ChannelCurve, ...]:
    """Return the curves of all channels that the messages contain, one curve for each component. Raises DecodeError if
    a message is invalid.
    """
    found: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for message in messages:
        for channel in decoded_channels(message.data):
            for part, value in zip(channel.parts, channel.values, strict=True):
                found.setdefault((part, channel.unit), []).append((message.time / 1e9, value))
    curves = ((name, np.array(points)) for name, points in found.items())
    return tuple(
        ChannelCurve(name=name, unit=unit, times=points[:, 0], values=points[:, 1])
        for (name, unit), points in curves
    )


Pose7 = tuple[float, float, float, float, float, float, float]  # m in W, and unit quaternion w, x, y, z


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Moment(Brief):
    """The state of a run at one moment."""

    time: float  # end of the servo period, s
    joints: Array  # sensed positions, shape (m,): rad, or m for prismatic joints
    gap: float  # sensed opening of the fingers, m
    poses: dict[str, Pose7]  # poses in W: position (m), then a unit quaternion w, x, y, z
    stage: str | None  # the present stage; None between two stages
    step: StepStarted | None  # the present step, or the last one, with its line and text
    picture: TakenPicture | None  # the last picture that was taken


@dataclass(frozen=True, slots=True)
class _StageSpan:
    time: float
    stage: str | None
    step: StepStarted | None


class Replay:
    """A recorded run, prepared so that its state at any time can be looked up. The run must have at least one servo
    period.
    """

    def __init__(
        self,
        motion: Motion,
        messages: Iterable[RawMessage],
        events: Iterable[AnyEvent],
        pictures: Sequence[TakenPicture],
    ) -> None:
        """Collect the poses of each servo period."""
        self._motion, self._pictures = motion, pictures
        self._told = _tellings(events)
        self.names, self.poses = _placed(moves(messages), len(motion.times))

    def seek(self, time: float) -> Moment:
        """Return the state at a time (s). For a time before the first servo period, return the first state. For a time
        after the last servo period, return the last state.
        """
        row = max(bisect_right(self._motion.times, time) - 1, 0)
        told = bisect_right(self._told, time, key=lambda telling: telling.time) - 1
        taken = bisect_right(self._pictures, time, key=lambda picture: picture.time) - 1
        return Moment(
            time=float(self._motion.times[row]),
            joints=self._motion.joints[row],
            gap=float(self._motion.gaps[row]),
            poses=Named(self._there(row)),
            stage=self._told[told].stage if told >= 0 else None,
            step=self._told[told].step if told >= 0 else None,
            picture=self._pictures[taken] if taken >= 0 else None,
        )

    def _there(self, row: int) -> Iterable[tuple[str, Pose7]]:
        for name, pose in zip(self.names, self.poses[row].tolist(), strict=True):
            x, y, z, qw, qx, qy, qz = pose
            if x == x:  # not NaN
                yield name, (x, y, z, qw, qx, qy, qz)


def moves(messages: Iterable[RawMessage]) -> Iterable[tuple[int, dict[str, Pose7]]]:
    """Yield, for each message about frames, the number of the servo period, counted from 0, and the poses of the
    frames that moved. A message before the first period has the number 0.
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
    """Return the names of the frames, and their poses in each servo period, shape (rows, frames, 7). Poses are
    NaN before a frame first appears.
    """
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


def _tellings(events: Iterable[AnyEvent]) -> list[_StageSpan]:
    told: list[_StageSpan] = []
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
        told.append(_StageSpan(event.time, stage, step))
    return told
