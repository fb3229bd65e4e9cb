"""What of a cell is written to a trace: frames of bodies that move, appear, and are not there any more."""

from typing import cast

import numpy as np
from foxglove_schemas_protobuf.FrameTransforms_pb2 import FrameTransforms

from handeye.trace.frames import NoFrames
from handeye.trace.mcap_writer import GrowingFile
from handeye.trace.writing import PUT_AWAY, TraceWriter


class Written:
    """A file that keeps where frames were written to be."""

    def __init__(self) -> None:
        self.heights: list[dict[str, float]] = []

    def write(self, topic: str, time: int, data: bytes) -> None:
        transforms = FrameTransforms.FromString(data).transforms
        self.heights.append({frame.child_frame_id: frame.translation.z for frame in transforms})


class TwoFrames(NoFrames):
    def __init__(self) -> None:
        super().__init__()
        self.names = ("base", "carrier")


def test_a_screw_that_was_driven_out_is_put_away_and_comes_back_when_it_is_driven_again() -> None:
    file = Written()
    writing = TraceWriter(cast("GrowingFile", file), TwoFrames(), b"")
    poses = np.array([[0, 0, 0, 1, 0, 0, 0], [0, 0, 0.5, 1, 0, 0, 0]], dtype=np.float32)
    both, base = np.array([True, True]), np.array([True, False])
    writing.frames(0.0, poses, base)  # it has not been driven yet
    writing.frames(1.0, poses, both)
    writing.frames(2.0, poses, base)
    poses[:, 2] += 0.25  # the base is carried off, and the body of the screw in its thread with it
    writing.frames(3.0, poses, base)
    writing.frames(4.0, poses, both)
    away = 2 * PUT_AWAY
    assert file.heights == [
        {"base": 0},
        {"carrier": 0.5},
        {"carrier": away},
        {"base": 0.25},
        {"carrier": 0.75},
    ]
