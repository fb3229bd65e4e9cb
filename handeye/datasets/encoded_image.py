"""An image that is encoded once, however often it is saved. Needs Pillow, of the extra `lerobot`."""

from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.PngImagePlugin import PngImageFile

AnyPath = str | bytes | PathLike[str] | PathLike[bytes]


class EncodedImage(PngImageFile):
    """A PNG image. If the image is saved several times, all files are links to the first one, where the file system
    allows that.

    LeRobot saves a file for each frame of an episode, but most frames repeat a picture.
    """

    def __init__(self, image: NDArray[np.uint8]) -> None:
        """Encode an image of red, green and blue, shape (height, width, 3), without loss."""
        encoded = BytesIO()
        Image.fromarray(image).save(encoded, "PNG", compress_level=9)
        self._encoded, self._saved = encoded.getvalue(), Path()  # a folder, to which there are no links
        super().__init__(BytesIO(self._encoded))

    def save(self, fp: AnyPath | IO[bytes], format: str | None = None, **params: Any) -> None:
        """Save the image. If the path ends in .png, the stored encoding is saved. Raises OSError if the file cannot be
        written.
        """
        path = Path(fp) if isinstance(fp, str | Path) else None
        if path is None or path.suffix != ".png" or format not in (None, "PNG"):
            super().save(fp, format, **params)
            return
        try:
            path.hardlink_to(self._saved)
        except OSError:  # its file was removed, or has too many links, or the file system knows no links
            path.unlink(missing_ok=True)  # so that nothing is written into a link to another image
            self._write(path)

    def _write(self, path: Path) -> None:
        try:
            path.write_bytes(self._encoded)
        except OSError:
            path.unlink(missing_ok=True)  # the library must not use a part of an image
            raise
        self._saved = path
