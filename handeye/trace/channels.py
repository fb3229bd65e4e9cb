"""Defines the channels of a trace, each with its content and the schema of its messages.

Robotics tools display the typed channels directly. The channel `/events` holds a lossless copy of each event; handeye
itself reads these copies.
"""

from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Final

import msgspec
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.JointStates_pb2 import JointStates
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from google.protobuf.message import Message

from handeye.program.event_reading import event_type
from handeye.program.events import CommonEvent
from handeye.trace.hand_message import channels_schema, hand_schema

FORMAT: Final = "handeye trace"
VERSION: Final = 4  # version of the format; a reader reads only this one
METADATA: Final = "handeye"  # metadata record on what the file is and what the run depended on
THINNED: Final = "thinned"  # metadata key that marks a file with only some servo periods
PLAN: Final = "plan.json"  # name of the attachment with the plan
PACKED_PLAN: Final = "plan.json.zst"  # in a thinned trace: compressed, or it would be a quarter of the file

JOINTS: Final = "/joint_states"
FRAMES: Final = "/tf"
PICTURE: Final = "/camera/picture"
LOG: Final = "/log"
SCENE: Final = "/scene"
EVENTS: Final = "/events"
HAND: Final = "/hand"
MACHINES: Final = "/channels"
ANNOTATIONS: Final = "/camera/annotations"
MOMENTS: Final = (JOINTS, FRAMES, PICTURE, HAND, MACHINES, ANNOTATIONS)  # recorded in addition to events

WORLD: Final = "world"  # name of the frame W, parent of all others


@dataclass(frozen=True, slots=True, kw_only=True)
class Channel:
    """A channel and the schema of its messages."""

    topic: str
    encoding: str
    schema_name: str
    schema_encoding: str
    schema: bytes


def _typed(topic: str, kind: type[Message]) -> Channel:
    """Define a channel of protobuf messages. The schema describes all types that the messages use."""
    files: dict[str, Any] = {}

    def add(file: Any) -> None:
        for needed in file.dependencies:
            add(needed)
        files.setdefault(file.name, file)

    add(kind.DESCRIPTOR.file)
    described = FileDescriptorSet()
    for file in files.values():
        file.CopyToProto(described.file.add())
    return Channel(
        topic=topic,
        encoding="protobuf",
        schema_name=kind.DESCRIPTOR.full_name,
        schema_encoding="protobuf",
        schema=described.SerializeToString(deterministic=True),
    )


def _schema(kind: Any) -> bytes:
    return msgspec.json.encode(msgspec.json.schema(kind), order="sorted")


CHANNELS: Final = (
    _typed(JOINTS, JointStates),
    _typed(FRAMES, FrameTransforms),
    _typed(PICTURE, RawImage),
    _typed(LOG, Log),
    _typed(SCENE, SceneUpdate),
    Channel(
        topic=EVENTS,
        encoding="json",
        schema_name="handeye.Event",
        schema_encoding="jsonschema",
        schema=_schema(CommonEvent),
    ),
    Channel(
        topic=HAND,
        encoding="json",
        schema_name="handeye.Hand",
        schema_encoding="jsonschema",
        schema=hand_schema(),
    ),
    _typed(ANNOTATIONS, ImageAnnotations),
    Channel(
        topic=MACHINES,
        encoding="json",
        schema_name="handeye.Channels",
        schema_encoding="jsonschema",
        schema=channels_schema(),
    ),
)  # all channels, in the order of their numbers in the file, which begin with 1


@cache
def channels_of(system: str) -> tuple[Channel, ...]:
    """Return the channels for runs of a system. The schema of the event channel includes the system's own kinds of
    events.
    """
    own = _schema(event_type(system))
    return tuple(replace(each, schema=own) if each.topic == EVENTS else each for each in CHANNELS)


NUMBERS: Final = {channel.topic: number for number, channel in enumerate(CHANNELS, 1)}


def nanoseconds(time: float) -> int:
    """Convert a simulated time (s) to ns, as traces store it.

    The time is rounded to a microsecond. Without this rounding, the clock of the cell (a sum of many steps) would
    differ slightly from the clock of the events (a rounded number).
    """
    return round(time * 1e6) * 1000
