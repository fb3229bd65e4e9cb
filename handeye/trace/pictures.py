"""The pictures of a run."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage

from handeye.ports.camera import Picture
from handeye.program.event_reading import EventReader
from handeye.program.events import PictureTaken
from handeye.trace.channels import EVENTS, PICTURE
from handeye.trace.messages import LEVEL
from handeye.trace.records import RawMessage


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TakenPicture:
    """A picture that the program took."""

    time: float
    """s"""
    name: str
    picture: Picture
    """Levels 0 to 15, shape (rows, columns), uint8."""


def read_pictures(messages: Iterable[RawMessage]) -> Iterator[TakenPicture]:
    """The pictures among messages, in order; the event that names one follows it.

    Raises:
        DecodeError, ValueError: a message is not what its channel says.
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
