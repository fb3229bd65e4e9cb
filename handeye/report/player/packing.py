"""Packs arrays for a page into few bytes. A JSON header is followed by the arrays, and all of it is compressed.

Arrays are stored by column, as differences of successive values. The differences contain many repeated bytes, which
compress well.
"""

import gzip
import json
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

_ALIGNED: Final = 4
"""Alignment of arrays (bytes). A script can read an aligned array in place."""


def packed(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Compress a header and arrays. The header gives the type, the first byte and the number of values of each
    array.

    The position of the first byte counts from the end of the header. The first four bytes of the data give the
    length of the header.
    """
    places, body = {}, b""
    for name, array in arrays.items():
        places[name] = [array.dtype.name, len(body), array.size]
        body += _padded(array.tobytes())
    text = json.dumps({**header, "arrays": places}, separators=(",", ":"), ensure_ascii=False).encode()
    head = _padded(text, b" ")
    return gzip.compress(len(head).to_bytes(4, "little") + head + body, mtime=0)


def _padded(data: bytes, filling: bytes = b"\0") -> bytes:
    return data + filling * (-len(data) % _ALIGNED)


def columns(values: NDArray[Any]) -> NDArray[np.uint16]:
    """Return the differences between successive rows of whole numbers, shape (n, k), one column after another.
    Differences wrap at 16 bits.
    """
    rows = values.astype(np.int64)
    steps = np.diff(rows, axis=0, prepend=np.zeros_like(rows[:1]))
    return steps.T.astype(np.uint16, order="C")


def zigzag(values: NDArray[Any]) -> NDArray[np.uint32]:
    """Return how much each whole number differs from the number before it, shape (n,). Negative differences become odd
    numbers, and positive ones even numbers: the differences 0, -1, 1, -2 become 0, 1, 2, 3.
    """
    steps = np.diff(values.astype(np.int64), prepend=0)
    return np.where(steps < 0, -2 * steps - 1, 2 * steps).astype(np.uint32)


def quantised(values: NDArray[Any]) -> tuple[NDArray[np.uint16], list[float]]:
    """Convert points, shape (n, 3), to 16-bit whole numbers. Also returns `least` (3 numbers) and `step`: a
    point is `least` + number * `step`.
    """
    least = values.min(axis=0)
    step = max(float(np.ptp(values, axis=0).max()), 1e-6) / 0xFFFF
    return np.rint((values - least) / step).astype(np.uint16), [*rounded(least), step]


def octahedral(normals: NDArray[Any]) -> NDArray[np.int8]:
    """Convert unit vectors, shape (n, 3), to two 8-bit numbers each, shape (n, 2). The two numbers are coordinates on
    an octahedron that is unfolded to a square.
    """
    flat = normals / np.abs(normals).sum(axis=1, keepdims=True)
    sign = np.where(flat[:, :2] >= 0, 1.0, -1.0)
    folded = (1 - np.abs(flat[:, 1::-1])) * sign
    return np.asarray(np.rint(127 * np.where(flat[:, 2:] < 0, folded, flat[:, :2])), dtype=np.int8)


def rounded(values: NDArray[Any]) -> list[float]:
    """Round numbers to seven decimals, to keep JSON short."""
    return [round(float(value), 7) for value in values]
