"""Encodes the typed messages of a trace, including the marks on pictures. Times are in ns on the cell's clock."""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any, Final

import numpy as np
from foxglove_schemas_protobuf.CircleAnnotation_pb2 import CircleAnnotation
from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.JointState_pb2 import JointState
from foxglove_schemas_protobuf.JointStates_pb2 import JointStates
from foxglove_schemas_protobuf.Log_pb2 import Log
from foxglove_schemas_protobuf.Point2_pb2 import Point2
from foxglove_schemas_protobuf.PointsAnnotation_pb2 import PointsAnnotation
from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3
from google.protobuf.timestamp_pb2 import Timestamp
from numpy.typing import NDArray

from handeye.core.pose import Array
from handeye.ports.camera import Picture
from handeye.ports.workcell import Sensed
from handeye.trace.channels import WORLD
from handeye.vision.marks import Colour, Disc, Line, Loop, Mark, Point

GAP: Final = "gap"  # name under which the opening of the fingers (m) is listed among the joints
CAMERA: Final = "camera"  # name of the frame of the pictures
LEVEL: Final = 255 // 15  # grey levels in an image for one step of the camera's digitiser
SECOND: Final = 10**9
_SETS: Final = 32  # sets of frames whose messages are kept

Poses = NDArray[np.float32]
"""Poses in W, shape (n, 7): position (m), then a unit quaternion w, x, y, z. Single precision resolves a
ten-thousandth of a millimetre. This is enough to view the cell, and it keeps files small.
"""


def stamp(time: int) -> Timestamp:
    return Timestamp(seconds=time // SECOND, nanos=time % SECOND)


class JointMessage:
    """The sensed position (rad or m) and rate of each joint, its torque (N m) or force (N), and the finger gap
    (m). One object is reused for all servo periods.
    """

    def __init__(self, names: tuple[str, ...]) -> None:
        joints = [JointState(name=name) for name in (*names, GAP)]
        self._message = JointStates(timestamp=stamp(0), joints=joints)
        *self._joints, self._gap = self._message.joints

    def filled(self, time: int, sensed: Sensed, effort: Array) -> bytes:
        """Fill in the values of a servo period, and encode the message."""
        self._message.timestamp.seconds, self._message.timestamp.nanos = divmod(time, SECOND)
        figures = zip(self._joints, sensed.q.tolist(), sensed.qd.tolist(), effort.tolist(), strict=True)
        for joint, q, qd, tau in figures:
            joint.position, joint.velocity, joint.effort = q, qd, tau
        self._gap.position = sensed.gap
        return self._message.SerializeToString()


class FramesMessage:
    """Poses of frames in W. One object is reused for all messages about the same frames, as in `JointMessage`."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self._names = names
        self._message = lru_cache(maxsize=_SETS)(self._empty)

    def filled(self, time: int, which: list[int], poses: list[list[float]]) -> bytes:
        """Encode poses of frames. `which` contains the frame number of each pose. Each pose has seven components, in
        the order of `Poses`.
        """
        seconds, nanos = divmod(time, SECOND)
        message, frames = self._message(tuple(which))
        for (when, place, turn), pose in zip(frames, poses, strict=True):
            when.seconds, when.nanos = seconds, nanos
            place.x, place.y, place.z, turn.w, turn.x, turn.y, turn.z = pose
        return message.SerializeToString()

    def _empty(
        self, which: tuple[int, ...]
    ) -> tuple[FrameTransforms, list[tuple[Timestamp, Vector3, Quaternion]]]:
        """Return a message about the given frames. Also return, for each frame, the objects for its time, position and
        rotation. The caller fills these objects in.
        """
        names = (self._names[number] for number in which)
        frames = [FrameTransform(parent_frame_id=WORLD, child_frame_id=name) for name in names]
        message = FrameTransforms(transforms=frames)
        return message, [(frame.timestamp, frame.translation, frame.rotation) for frame in message.transforms]


def picture(time: int, levels: Picture) -> bytes:
    """Encode a picture. The grey levels of the picture, 0 to 15, are scaled to the range of a byte."""
    height, width = levels.shape
    grey = (levels * np.uint8(LEVEL)).tobytes()
    return RawImage(
        timestamp=stamp(time),
        frame_id=CAMERA,
        width=width,
        height=height,
        encoding="mono8",
        step=width,
        data=grey,
    ).SerializeToString()


def log(time: int, level: Log.Level.ValueType, sentence: str, *, name: str, file: str, line: int) -> bytes:
    """Encode a sentence as a log message. `name` is the name of the program; `file` and `line` are the place in
    the script (line 0 if the sentence belongs to no line).
    """
    message = Log(timestamp=stamp(time), level=level, message=sentence, name=name, file=file, line=line)
    return message.SerializeToString()


def annotations(taken: int, marks: Sequence[Mark]) -> bytes:
    """Encode the marks on a picture. Tools find the picture by the time at which it was taken (ns)."""
    message = ImageAnnotations(timestamp=stamp(taken))
    for mark in marks:
        match mark:
            case Loop():
                message.points.append(_lines(mark, PointsAnnotation.LINE_LOOP, mark.points, taken))
            case Line():
                message.points.append(_lines(mark, PointsAnnotation.LINE_STRIP, mark.ends, taken))
            case Disc():
                message.circles.append(_disc(mark, taken))
    return message.SerializeToString()


def read_annotations(data: bytes) -> tuple[int, tuple[Mark, ...]]:
    """Decode marks. Returns the time (ns) at which a picture was taken, and the marks on that picture.
    Raises DecodeError if the data are not marks.
    """
    message = ImageAnnotations.FromString(data)
    return message.timestamp.seconds * SECOND + message.timestamp.nanos, tuple(_marks(message))


def _marks(message: ImageAnnotations) -> Iterator[Mark]:
    """Yield the marks of a message in drawing order: lines first, then discs."""
    for lines in message.points:
        points = tuple((point.x - 0.5, point.y - 0.5) for point in lines.points)
        colour = _levels(lines.outline_color)
        if lines.type == PointsAnnotation.LINE_LOOP:
            yield Loop(points=points, colour=colour, width=lines.thickness)
        elif len(points) == 2:
            yield Line(ends=(points[0], points[1]), colour=colour, width=lines.thickness)
    for disc in message.circles:
        centre = disc.position.x - 0.5, disc.position.y - 0.5
        yield Disc(centre=centre, colour=_levels(disc.fill_color), diameter=disc.diameter)


def _levels(colour: Any) -> Colour:
    r, g, b = (round(255 * share) for share in (colour.r, colour.g, colour.b))
    return r, g, b


def _lines(
    mark: Loop | Line, kind: PointsAnnotation.Type.ValueType, points: Sequence[Point], taken: int
) -> PointsAnnotation:
    return PointsAnnotation(
        timestamp=stamp(taken),
        type=kind,
        points=map(_point, points),
        outline_color=_colour(mark.colour),
        thickness=mark.width,
    )


def _disc(mark: Disc, taken: int) -> CircleAnnotation:
    return CircleAnnotation(
        timestamp=stamp(taken),
        position=_point(mark.centre),
        diameter=mark.diameter,
        fill_color=_colour(mark.colour),
        outline_color=_colour(mark.colour),
        thickness=1.0,
    )


def _point(point: Point) -> Point2:
    """Convert a point of a picture to the message's coordinates. The message's origin is the corner of the first
    pixel; the origin of our points is the pixel's centre.
    """
    u, v = point
    return Point2(x=u + 0.5, y=v + 0.5)


def _colour(colour: Colour) -> Color:
    r, g, b = (level / 255 for level in colour)
    return Color(r=r, g=g, b=b, a=1.0)
