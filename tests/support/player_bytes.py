"""Decodes the player's bytes independently of the code that makes them and of the page's script."""

import gzip
import json
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

QUATERNION = 8191
"""The number that stands for 1 in a component of a quaternion."""


@dataclass(frozen=True)
class Unpacked:
    """A header and arrays."""

    header: dict[str, Any]
    body: bytes

    @classmethod
    def of(cls, data: bytes) -> Self:
        raw = gzip.decompress(data)
        after = 4 + int.from_bytes(raw[:4], "little")
        return cls(json.loads(raw[4:after]), raw[after:])

    def array(self, name: str) -> NDArray[Any]:
        kind, first, count = self.header["arrays"][name]
        return np.frombuffer(self.body, dtype=kind, offset=first, count=count)

    def rows(self, name: str, width: int, kind: str = "uint16") -> NDArray[np.float64]:
        """Return whole numbers of 16 bits as rows."""
        steps = self.array(name).reshape(width, -1)
        return np.cumsum(steps, axis=1, dtype=np.uint16).view(kind).T.astype(float)

    def summed(self, name: str) -> NDArray[np.int64]:
        """Return whole numbers that are stored as differences, with the sign in the lowest bit."""
        steps = self.array(name).astype(np.int64)
        return np.cumsum(np.where(steps % 2, -(steps + 1) // 2, steps // 2))


@dataclass(frozen=True)
class SeenTracks:
    """Tracks as a page shows them."""

    unpacked: Unpacked

    @classmethod
    def of(cls, data: bytes) -> Self:
        return cls(Unpacked.of(data))

    @cached_property
    def clock(self) -> NDArray[np.float64]:
        """Ends of the servo periods, s."""
        return np.cumsum(self.unpacked.array("clock")) / 1e6

    @cached_property
    def _rows(self) -> tuple[NDArray[Any], ...]:
        data = self.unpacked
        return data.summed("periods"), data.rows("places", 3), data.rows("turns", 4, "int16") / QUATERNION

    def pose(self, body: str, period: int) -> NDArray[np.float64] | None:
        """Place and quaternion of a body in a servo period; None if the body is hidden."""
        if body in self.unpacked.header["still"]:
            return np.array(self.unpacked.header["still"][body])
        row = 0
        for told in self.unpacked.header["moving"]:
            for first, after, count in told["spans"]:
                if told["body"] == body and first <= period < after:
                    return self._between(slice(row, row + count), period, told["scale"])
                row += count
        return None

    def _between(self, rows: slice, period: int, scale: list[float]) -> NDArray[np.float64]:
        periods, places, turns = (values[rows] for values in self._rows)
        metres = np.array(scale[:3]) + scale[3] * places
        pose = np.array([np.interp(period, periods, column) for column in np.column_stack([metres, turns]).T])
        pose[3:] /= np.linalg.norm(pose[3:])
        return pose
