"""Marks on a picture as the message that robotics tools draw over it, and back again."""

from collections.abc import Iterator, Sequence
from typing import Any

from foxglove_schemas_protobuf.CircleAnnotation_pb2 import CircleAnnotation
from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.ImageAnnotations_pb2 import ImageAnnotations
from foxglove_schemas_protobuf.Point2_pb2 import Point2
from foxglove_schemas_protobuf.PointsAnnotation_pb2 import PointsAnnotation

from handeye.trace.messages import SECOND, stamp
from handeye.vision.marks import Colour, Disc, Line, Loop, Mark, Point


def annotations(taken: int, marks: Sequence[Mark]) -> bytes:
    """Marks on the picture taken at a time (ns), which is how the tools find it."""
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
    """The time (ns) of the picture that marks are on, and the marks; raises DecodeError if there are none."""
    message = ImageAnnotations.FromString(data)
    return message.timestamp.seconds * SECOND + message.timestamp.nanos, tuple(_marks(message))


def _marks(message: ImageAnnotations) -> Iterator[Mark]:
    """The marks of a message: lines first, then discs, which is the order they are drawn in."""
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
    """A picture point; theirs count from the corner of the first point, ours from its middle."""
    u, v = point
    return Point2(x=u + 0.5, y=v + 0.5)


def _colour(colour: Colour) -> Color:
    r, g, b = (level / 255 for level in colour)
    return Color(r=r, g=g, b=b, a=1.0)
