"""Checkpoints that nobody saved, with right checksums."""

import hashlib
import zlib

import msgspec

from handeye.runs.checkpoint_file import VERSION


def sealed(rest: bytes, version: int = VERSION) -> bytes:
    """A file with a right checksum, whatever is in it."""
    return f"handeye-checkpoint {version} {hashlib.sha256(rest).hexdigest()}\n".encode() + rest


def changed(data: bytes, **fields: object) -> bytes:
    """A checkpoint with other things in its body, rightly sealed."""
    _, head, packed = data.split(b"\n", 2)
    body = msgspec.msgpack.decode(zlib.decompress(packed))
    return sealed(head + b"\n" + zlib.compress(msgspec.msgpack.encode({**body, **fields})))
