"""Marks on a picture are read as they were written."""

import numpy as np
import pytest
from google.protobuf.message import DecodeError
from recordings import MARKS

from handeye.trace.messages import annotations, read_annotations
from handeye.vision.marks import Disc, Line, Loop, Mark

TAKEN = 12_345_678_901


def numbers(mark: Mark) -> tuple[object, ...]:
    """What a mark is, and where."""
    match mark:
        case Loop():
            return Loop, mark.points, mark.colour, round(mark.width, 6)
        case Line():
            return Line, mark.ends, mark.colour, round(mark.width, 6)
        case Disc():
            return Disc, mark.centre, mark.colour, mark.diameter


def test_marks_come_back_with_the_time_of_their_picture() -> None:
    taken, marks = read_annotations(annotations(TAKEN, MARKS))
    assert taken == TAKEN
    assert [*map(numbers, marks)] == [*map(numbers, MARKS)]


def test_what_is_no_message_of_marks_is_refused() -> None:
    with pytest.raises(DecodeError):
        read_annotations(np.arange(64, dtype=np.uint8).tobytes())
