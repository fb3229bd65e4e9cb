"""Stores states in files, as compressed MessagePack with arrays. The first line of a file gives the file's kind,
version and digest.

A file that is truncated, has a wrong bit, or would fill the memory is refused before its content is used.
"""

import hashlib
import zlib
from typing import Any, Final, TypeVar

import msgspec
import numpy as np

T = TypeVar("T")
_DTYPES: Final = ("<f8", "|u1")


def sealed(magic: str, version: int, rest: bytes) -> bytes:
    """Put a line with kind, version and digest before the bytes `rest`."""
    return f"{magic} {version} {hashlib.sha256(rest).hexdigest()}\n".encode() + rest


def packed(record: object) -> bytes:
    """Encode and compress a record."""
    return zlib.compress(encoded(record), 1)


def unpacked(data: bytes, kind: type[T], largest: int) -> T:
    """Decode bytes made by `packed`. Raises ValueError if the bytes are invalid or inflate to more than `largest`
    bytes.
    """
    try:
        return decoded(_inflated(data, largest), kind)
    except zlib.error as error:
        raise ValueError(str(error)) from None


def encoded(record: object) -> bytes:
    """Encode a record as MessagePack."""
    return msgspec.msgpack.encode(record, enc_hook=_plain)


def decoded(data: bytes | msgspec.Raw, kind: type[T]) -> T:
    """Decode a record made by `encoded`. Raises ValueError if the bytes are invalid."""
    try:
        return msgspec.msgpack.decode(data, type=kind, dec_hook=_array)
    except (msgspec.DecodeError, TypeError, RecursionError) as error:
        raise ValueError(str(error)) from None


def _inflated(data: bytes, largest: int) -> bytes:
    inflater = zlib.decompressobj()
    inflated = inflater.decompress(data, largest)
    if inflater.unconsumed_tail or not inflater.eof:
        raise ValueError("the saved state is incomplete or too large")
    return inflated


def _plain(value: Any) -> Any:
    """Convert an array or NumPy number to types that MessagePack knows."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, np.floating):
        return float(value)
    raise TypeError(f"a checkpoint cannot contain a value of type {type(value).__name__}")


def _array(kind: type, value: Any) -> Any:
    dtype, shape, data = value
    if dtype not in _DTYPES:
        raise ValueError(f"a checkpoint cannot contain an array of type {dtype!r}")
    return np.frombuffer(data, dtype).reshape(shape)
