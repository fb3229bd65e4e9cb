"""States on disk: MessagePack with arrays, compressed, behind a line that says what it is and what its digest is.

A file that is cut short, or in which any bit is wrong, is refused before anything in it is used; so is one that would
fill the memory.
"""

import hashlib
import zlib
from typing import Any, Final, TypeVar

import msgspec
import numpy as np

T = TypeVar("T")
_KINDS: Final = ("<f8", "|u1")
"""Arrays of a state: figures and pictures."""


def sealed(magic: str, version: int, rest: bytes) -> bytes:
    """Bytes behind a line with their kind, its version, and their digest."""
    return f"{magic} {version} {hashlib.sha256(rest).hexdigest()}\n".encode() + rest


def packed(record: object) -> bytes:
    """A record as compressed bytes."""
    return zlib.compress(encoded(record), 1)


def unpacked(data: bytes, kind: type[T], largest: int) -> T:
    """The record that `packed` made bytes of; `largest` is the most bytes that it may have."""
    try:
        return decoded(_inflated(data, largest), kind)
    except zlib.error as error:
        raise ValueError(str(error)) from None


def encoded(record: object) -> bytes:
    """A record as MessagePack."""
    return msgspec.msgpack.encode(record, enc_hook=_plain)


def decoded(data: bytes | msgspec.Raw, kind: type[T]) -> T:
    """The record that `encoded` made bytes of."""
    try:
        return msgspec.msgpack.decode(data, type=kind, dec_hook=_array)
    except (msgspec.DecodeError, TypeError, RecursionError) as error:
        raise ValueError(str(error)) from None


def _inflated(data: bytes, largest: int) -> bytes:
    inflater = zlib.decompressobj()
    inflated = inflater.decompress(data, largest)
    if inflater.unconsumed_tail or not inflater.eof:
        raise ValueError("its state is too large, or not whole")
    return inflated


def _plain(value: Any) -> Any:
    """An array, or a number of one, as something MessagePack knows."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, np.floating):
        return float(value)
    raise TypeError(f"no {type(value).__name__} belongs in a checkpoint")


def _array(kind: type, value: Any) -> Any:
    """The array that `_plain` made plain."""
    dtype, shape, data = value
    if dtype not in _KINDS:
        raise ValueError(f"no array of {dtype!r} belongs in a checkpoint")
    return np.frombuffer(data, dtype).reshape(shape)
