"""Packs arrays into few bytes for a page: a header in JSON, then the arrays one after another, compressed.

Arrays are stored by column and as differences, because repeated bytes compress well.
"""

import gzip
import json
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

_ALIGNED: Final = 4
"""Alignment of arrays, bytes: a script can then read an array in place."""


def packed(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Compress a header and arrays. The header has the type, first byte and number of values of each array.

    The first byte counts from the end of the header; the first four bytes of the data give the length of the
    header.
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
    """Differences along each column of whole numbers, shape (n, k), column after column; differences wrap at 16
    bits.
    """
    rows = values.astype(np.int64)
    steps = np.diff(rows, axis=0, prepend=np.zeros_like(rows[:1]))
    return steps.T.astype(np.uint16, order="C")


def zigzag(values: NDArray[Any]) -> NDArray[np.uint32]:
    """Differences of whole numbers, shape (n,), with negative ones as odd numbers: 0, -1, 1, -2 become 0, 1, 2, 3."""
    steps = np.diff(values.astype(np.int64), prepend=0)
    return np.where(steps < 0, -2 * steps - 1, 2 * steps).astype(np.uint32)


def quantised(values: NDArray[Any]) -> tuple[NDArray[np.uint16], list[float]]:
    """Points, shape (n, 3), as 16-bit whole numbers, and `least` (3 numbers) and `step`: the points are `least` +
    number * `step`.
    """
    least = values.min(axis=0)
    step = max(float(np.ptp(values, axis=0).max()), 1e-6) / 0xFFFF
    return np.rint((values - least) / step).astype(np.uint16), [*rounded(least), step]


def octahedral(normals: NDArray[Any]) -> NDArray[np.int8]:
    """Unit vectors, shape (n, 3), as two 8-bit numbers each, shape (n, 2): positions on an octahedron unfolded to a
    square.
    """
    flat = normals / np.abs(normals).sum(axis=1, keepdims=True)
    sign = np.where(flat[:, :2] >= 0, 1.0, -1.0)
    folded = (1 - np.abs(flat[:, 1::-1])) * sign
    return np.asarray(np.rint(127 * np.where(flat[:, 2:] < 0, folded, flat[:, :2])), dtype=np.int8)


def rounded(values: NDArray[Any]) -> list[float]:
    """Figures rounded to seven decimals, to keep JSON short."""
    return [round(float(value), 7) for value in values]
