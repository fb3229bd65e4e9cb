"""Arrays as the few bytes that a page carries: a header in JSON, then the arrays one after the other, compressed.

Bytes repeat, and so compress, where neighbours are alike: arrays go column by column, as differences.
"""

import gzip
import json
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

_ALIGNED: Final = 4
"""Bytes that the beginning of an array is a multiple of: what a script may look at where it lies."""


def packed(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """A header and arrays, compressed. The header tells for each array its kind, first byte and number of values.

    First byte: counted from the end of the header, which is as long as the first four bytes say.
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
    """Differences down each column of whole numbers, shape (n, k), one column after the other; they wrap."""
    rows = values.astype(np.int64)
    steps = np.diff(rows, axis=0, prepend=np.zeros_like(rows[:1]))
    return steps.T.astype(np.uint16, order="C")


def zigzag(values: NDArray[Any]) -> NDArray[np.uint32]:
    """Differences of whole numbers, shape (n,), those below zero as odd numbers: 0, -1, 1, -2 are 0, 1, 2, 3."""
    steps = np.diff(values.astype(np.int64), prepend=0)
    return np.where(steps < 0, -2 * steps - 1, 2 * steps).astype(np.uint32)


def quantised(values: NDArray[Any]) -> tuple[NDArray[np.uint16], list[float]]:
    """Points, shape (n, 3), as whole numbers of 16 bits; and what they were, `least` (3 numbers) + number * `step`."""
    least = values.min(axis=0)
    step = max(float(np.ptp(values, axis=0).max()), 1e-6) / 0xFFFF
    return np.rint((values - least) / step).astype(np.uint16), [*rounded(least), step]


def octahedral(normals: NDArray[Any]) -> NDArray[np.int8]:
    """Unit vectors, shape (n, 3), as two numbers of 8 bits: an octahedron unfolded to a square; shape (n, 2)."""
    flat = normals / np.abs(normals).sum(axis=1, keepdims=True)
    sign = np.where(flat[:, :2] >= 0, 1.0, -1.0)
    folded = (1 - np.abs(flat[:, 1::-1])) * sign
    return np.asarray(np.rint(127 * np.where(flat[:, 2:] < 0, folded, flat[:, :2])), dtype=np.int8)


def rounded(values: NDArray[Any]) -> list[float]:
    """Figures to a tenth of a thousandth of a millimetre: short in JSON."""
    return [round(float(value), 7) for value in values]
