"""The pictures of the television camera as PNG files of their own four bits."""

import struct
import zlib
from typing import Final

import numpy as np

from handeye.ports.camera import Picture

_BEGIN: Final = b"\x89PNG\r\n\x1a\n"
_GREY: Final = 0
_BITS: Final = 4


def picture_png(picture: Picture) -> bytes:
    """A picture as a PNG file: grey, four bits a point, each level as it was."""
    height, width = picture.shape
    head = struct.pack(">IIBBBBB", width, height, _BITS, _GREY, 0, 0, 0)
    return (
        _BEGIN
        + _chunk(b"IHDR", head)
        + _chunk(b"IDAT", zlib.compress(_lines(picture), 9))
        + _chunk(b"IEND", b"")
    )


def _lines(picture: Picture) -> bytes:
    """The lines of a picture, two points a byte, each line behind the number of its filter: none."""
    even = np.pad(picture, ((0, 0), (0, picture.shape[1] % 2)))
    packed = (even[:, ::2] << 4 | even[:, 1::2]).astype(np.uint8)
    return np.pad(packed, ((0, 0), (1, 0))).tobytes()


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
