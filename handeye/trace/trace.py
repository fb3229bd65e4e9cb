"""A trace as it was read: the events, and what was recorded between them."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.JointStates_pb2 import JointStates
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
from google.protobuf.message import DecodeError

from handeye.errors import InvalidInput
from handeye.events import AnyEvent, PictureTaken, RunStarted
from handeye.ports.camera import Picture
from handeye.pose import Array
from handeye.trace.channels import EVENTS, FRAMES, JOINTS, MOMENTS, PICTURE, REPEATABLE
from handeye.trace.events_read import read_event
from handeye.trace.messages import GAP, LEVEL
from handeye.trace.records import RawMessage, read_messages

Pose7 = tuple[float, float, float, float, float, float, float]
"""Place of a frame in W (m) and its unit quaternion w, x, y, z."""

Read = TypeVar("Read")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Tick:
    """A servo period as it was recorded."""

    time: float
    """s"""
    q: Array
    """Joint positions by the sensors, shape (n,), rad and m."""
    qd: Array
    """Joint rates by the sensors, shape (n,)."""
    effort: Array
    """Torques put out, shape (n,), N m and (prismatic joints) N."""
    gap: float
    """m"""
    moved: dict[str, Pose7]
    """Frames that were written at its end."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TakenPicture:
    """A picture of the run."""

    time: float
    """s"""
    name: str
    picture: Picture


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trace:
    """A trace that was read, and found sound."""

    name: str
    version: int
    """Of the format."""
    head: RunStarted
    plan: bytes
    """`plan.json` of the run."""
    events: tuple[AnyEvent, ...]
    counts: dict[str, int]
    """Messages on each channel that has any."""
    data: bytes = field(repr=False)
    """The file."""
    lenient: bool

    @property
    def unseen(self) -> int:
        """Events before the first of which more was recorded than that they happened.

        More than the start of the run and of its first stage, if it was taken up from a checkpoint. None of a system
        that moves no arm.
        """
        if not self.head.arm:
            return 0
        events = 0
        for message in self.messages():
            if message.topic in MOMENTS:
                break
            events += message.topic == EVENTS
        return events

    @property
    def begins(self) -> float:
        """The clock from which on its motions are recorded, s."""
        return self.events[max(self.unseen - 1, 0)].time

    def elapsed(self, clock: float) -> float:
        """Seconds from the beginning of the run to a time by the cell's clock: what people see."""
        return round(clock - self.head.time, 6)

    def check_repeatable(self) -> None:
        """Make sure that the cell of the run can be built again.

        Raises:
            InvalidInput: an older handeye recorded it.
        """
        if self.version < REPEATABLE:
            raise InvalidInput(
                f"{self.name} was recorded by an older handeye, whose cell this one cannot build again: `trace show` "
                "and `trace stats` read it; for the rest, run the plan again"
            )

    def messages(self) -> Iterator[RawMessage]:
        """All messages, in the order they were written."""
        return read_messages(self.data, lenient=self.lenient)

    def ticks(self) -> Iterator[Tick]:
        """The servo periods, each with the frames written until the next; those before the first come with it.

        Raises:
            InvalidInput: a message is not what its channel says.
        """
        tick: Tick | None = None
        moved: dict[str, Pose7] = {}
        for message in self.messages():
            if message.topic == FRAMES:
                moved.update(self._read(_poses, message))
            elif message.topic == JOINTS:
                if tick is not None:
                    yield tick
                    moved = {}
                tick = replace(self._read(_tick, message), moved=moved)
        if tick is not None:
            yield tick

    def pictures(self) -> Iterator[TakenPicture]:
        """The pictures the program took, in order; the event that names one follows it.

        Raises:
            InvalidInput: a message is not what its channel says.
        """
        picture: Picture | None = None
        for message in self.messages():
            if message.topic == PICTURE:
                picture = self._read(_picture, message)
            elif message.topic == EVENTS and picture is not None:
                event = read_event(message.data)
                if isinstance(event, PictureTaken):
                    yield TakenPicture(time=event.time, name=event.picture, picture=picture)
                    picture = None

    def _read(self, make: Callable[[RawMessage], Read], message: RawMessage) -> Read:
        try:
            return make(message)
        except (DecodeError, KeyError, ValueError):
            when = f"at {self.elapsed(message.time / 1e9):.3f} s"
            raise InvalidInput(
                f"{self.name}: the message on {message.topic} {when} cannot be understood"
            ) from None


def _tick(message: RawMessage) -> Tick:
    joints = {joint.name: joint for joint in JointStates.FromString(message.data).joints}
    gap = joints.pop(GAP).position
    return Tick(
        time=message.time / 1e9,
        q=np.array([joint.position for joint in joints.values()]),
        qd=np.array([joint.velocity for joint in joints.values()]),
        effort=np.array([joint.effort for joint in joints.values()]),
        gap=gap,
        moved={},
    )


def _poses(message: RawMessage) -> dict[str, Pose7]:
    found: dict[str, Pose7] = {}
    for frame in FrameTransforms.FromString(message.data).transforms:
        p, r = frame.translation, frame.rotation
        found[frame.child_frame_id] = (p.x, p.y, p.z, r.w, r.x, r.y, r.z)
    return found


def _picture(message: RawMessage) -> Picture:
    image = RawImage.FromString(message.data)
    grey = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width)
    return grey // np.uint8(LEVEL)
