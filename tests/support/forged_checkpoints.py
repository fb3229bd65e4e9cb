"""Forged checkpoints with correct checksums."""

import hashlib
import zlib

import msgspec

from handeye.runs.checkpoint_file import VERSION


def sealed(rest: bytes, version: int = VERSION) -> bytes:
    """Return a file with a correct checksum, whatever its content."""
    return f"handeye-checkpoint {version} {hashlib.sha256(rest).hexdigest()}\n".encode() + rest


def changed(data: bytes, **fields: object) -> bytes:
    """Return a checkpoint with another body and a correct checksum."""
    _, head, packed = data.split(b"\n", 2)
    body = msgspec.msgpack.decode(zlib.decompress(packed))
    return sealed(head + b"\n" + zlib.compress(msgspec.msgpack.encode({**body, **fields})))
