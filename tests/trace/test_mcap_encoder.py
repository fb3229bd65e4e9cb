"""Our encoder of MCAP files writes what the MCAP project's own writer writes."""

from io import BytesIO

from mcap.records import Attachment, Channel, Metadata, Schema
from mcap.writer import Writer

from handeye.trace.mcap_encoder import McapEncoder

MESSAGES = [(1, 5, b"one"), (2, 7, b""), (1, 6, b"\0" * 300)], [(2, 9, b"two")], [(2, 9, b"a"), (1, 9, b"b")]
"""Channel, time and content of each message, by chunk."""


def _by_the_library() -> bytes:
    file = BytesIO()
    writer = Writer(file, chunk_size=1 << 62, enable_data_crcs=True)
    writer.start(library="ours")
    writer.add_metadata("about", {"key": "value"})
    writer.add_attachment(0, 5, "plan", "text/plain", b"plan")
    for topic in ("/first", "/second"):
        writer.register_channel(
            topic, "json", writer.register_schema(f"schema of {topic}", "jsonschema", b"{}")
        )
    for chunk in MESSAGES:
        for channel, time, data in chunk:
            writer.add_message(channel, time, data, time)
        writer.flush()
    writer.finish()
    return file.getvalue()


def test_the_bytes_are_those_of_the_library() -> None:
    channels = [
        (
            Schema(number, b"{}", "jsonschema", f"schema of {topic}"),
            Channel(number, topic, "json", {}, number),
        )
        for number, topic in enumerate(("/first", "/second"), 1)
    ]
    encoder = McapEncoder()
    plan = Attachment(0, 5, "plan", "text/plain", b"plan")
    pieces = [encoder.front("ours", Metadata("about", {"key": "value"}), plan, channels)]
    for chunk in MESSAGES:
        for message in chunk:
            encoder.add(*message)
            assert encoder.part()  # which is no piece of the file
        pieces.append(encoder.chunk())
    assert b"".join([*pieces, encoder.chunk(), encoder.end()]) == _by_the_library()
