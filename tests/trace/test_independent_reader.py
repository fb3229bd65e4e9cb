"""The MCAP project's own reader, with its own protobuf decoder, finds in a trace what we say is in it."""

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest
from mcap.reader import DecodedMessageTuple, make_reader
from mcap_protobuf.decoder import DecoderFactory
from recordings import EVENTS, HISTORY, PLAN, record

from handeye.ports.workcell import Sensed
from handeye.program.events import to_line

TYPES = {
    "/joint_states": "foxglove.JointStates",
    "/tf": "foxglove.FrameTransforms",
    "/camera/picture": "foxglove.RawImage",
    "/log": "foxglove.Log",
    "/scene": "foxglove.SceneUpdate",
    "/events": "handeye.Event",
    "/hand": "handeye.Hand",
    "/channels": "handeye.Channels",
    "/camera/annotations": "foxglove.ImageAnnotations",
}


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("trace") / "short.mcap"
    record(path)
    return path


def _decoded(path: Path, *topics: str) -> Iterator[DecodedMessageTuple]:
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        yield from reader.iter_decoded_messages(topics or None)


def _seconds(stamp: Any) -> float:
    return float(stamp.seconds + stamp.nanos * 1e-9)


def test_the_channels_have_the_types_that_tools_expect(path: Path) -> None:
    with path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    found = {channel.topic: summary.schemas[channel.schema_id].name for channel in summary.channels.values()}
    assert found == TYPES


def test_the_events_are_there_as_json_that_fits_their_schema(path: Path) -> None:
    with path.open("rb") as file:
        messages = list(make_reader(file).iter_messages("/events"))
    assert [message.data + b"\n" for _, _, message in messages] == [to_line(event) for event in EVENTS]
    schema = messages[0][0]
    assert schema is not None
    kinds = msgspec.json.decode(schema.data)["$defs"]
    assert {type(event).__name__ for event in EVENTS} <= set(kinds)


def test_the_times_are_those_of_the_cells_clock(path: Path) -> None:
    periods = [moment.what.time for moment in HISTORY if isinstance(moment.what, Sensed)]
    states = list(_decoded(path, "/joint_states"))
    assert [message.log_time * 1e-9 for _, _, message, _ in states] == pytest.approx(periods, abs=1e-6)
    assert all(message.publish_time == message.log_time for _, _, message, _ in states)
    for _, _, message, content in states:
        assert _seconds(content.timestamp) == pytest.approx(message.log_time * 1e-9)


def test_the_joints_have_names_and_figures(path: Path) -> None:
    first = next(moment for moment in HISTORY if isinstance(moment.what, Sensed))
    content = next(_decoded(path, "/joint_states")).decoded_message
    assert [joint.name for joint in content.joints] == [
        "column", "shoulder", "boom", "wrist roll", "wrist bend", "hand roll", "gap",
    ]  # fmt: skip
    assert [joint.effort for joint in content.joints[:6]] == first.effort.tolist()
    assert not content.joints[6].HasField("velocity")


def test_the_frames_stand_in_the_world_and_are_told_anew_at_each_step(path: Path) -> None:
    steps = [event.time for event in EVENTS if type(event).__name__ == "StepStarted"]
    whole = [
        message.log_time * 1e-9
        for _, _, message, content in _decoded(path, "/tf")
        if {frame.child_frame_id for frame in content.transforms} >= {"base", "finger"}
    ]
    assert whole == pytest.approx(steps)
    frames = [frame for found in _decoded(path, "/tf") for frame in found.decoded_message.transforms]
    assert {frame.parent_frame_id for frame in frames} == {"world"}
    assert all(frame.rotation.w == 1.0 for frame in frames)


def test_the_picture_is_a_grey_image_of_its_time(path: Path) -> None:
    ((_, _, message, image),) = _decoded(path, "/camera/picture")
    taken = next(moment for moment in HISTORY if moment.picture is not None)
    assert taken.picture is not None
    assert (image.encoding, image.height, image.width, image.step) == ("mono8", 4, 6, 6)
    assert image.data == bytes(17 * int(level) for level in taken.picture.ravel())
    assert message.log_time * 1e-9 == pytest.approx(taken.what.time)


def test_what_was_found_stands_on_the_picture_of_its_time(path: Path) -> None:
    ((_, _, _, image),) = _decoded(path, "/camera/picture")
    (_, _, _, bare), (_, _, _, found) = _decoded(path, "/camera/annotations")
    assert _seconds(bare.timestamp) == _seconds(found.timestamp) == _seconds(image.timestamp)
    assert not [*bare.points, *bare.circles]
    loop, line = found.points
    corners = [(point.x, point.y) for point in loop.points]
    assert corners == [(1.5, 0.5), (4.5, 0.5), (4.5, 3.5), (1.5, 3.5)]  # from the corner of the picture
    assert [len(line.points), len(found.circles)] == [2, 1]
    assert found.circles[0].position.x == 3.0


def test_the_log_tells_the_story_with_lines_of_the_source(path: Path) -> None:
    told = [found.decoded_message for found in _decoded(path, "/log")]
    assert Counter(entry.level for entry in told) == {1: 9, 2: 19}
    assert told[2].message == "OPEN 1"
    assert (told[2].file, told[2].line) == ("short", 2)
    assert told[3].message == "stopped: the hand presses with 32.4 ounces, over 28.8"


def test_the_plan_and_what_the_run_depended_on_stand_before_everything(path: Path) -> None:
    with path.open("rb") as file:
        reader = make_reader(file)
        (plan,), (metadata,) = reader.iter_attachments(), reader.iter_metadata()
    assert (plan.name, plan.data) == ("plan.json", PLAN)
    assert metadata.metadata["format"] == "handeye trace"
    assert (metadata.metadata["seed"], metadata.metadata["versions.mujoco"]) == ("7", "4")
