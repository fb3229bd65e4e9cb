"""Stores calibrations for later runs, as files in the user's cache. A file's name is a digest of the conditions
of the calibration.

A file that cannot be used is replaced. Several processes may write at the same time, because each file is written
atomically, and files for equal conditions have equal bytes.
"""

import hashlib
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Final

import msgspec

from handeye.core.errors import CannotWrite, InvalidInput
from handeye.core.files import read_whole, write_whole
from handeye.core.packed import packed, sealed, unpacked
from handeye.core.record import Record
from handeye.core.resources import cache_folder
from handeye.core.variation import WorldSpec
from handeye.ports.camera import Renderer
from handeye.systems.stanford.preparation import Conditions, Preparation

MAGIC: Final = "handeye-calibration"
VERSION: Final = 2
ENDING: Final = ".calibration"
LARGEST: Final = 1 << 20  # bytes of one file, also unpacked; a calibration of the water pump takes about 6 kB
MOST: Final = 1 << 24  # bytes of all files; beyond this the oldest are removed
_ABANDONED_S: Final = 3600.0  # age at which an unfinished file is removed


class KeptCalibration(Record, frozen=True, kw_only=True):
    """A stored calibration, as `handeye cache` lists it."""

    file: str
    bytes: int
    age_s: float
    task: str
    world: WorldSpec
    camera: Renderer


class KeptCalibrations:
    """The calibrations in a folder. Without a folder, no calibrations are stored or found."""

    def __init__(self, folder: Path | None, most: int = MOST) -> None:
        """Use a folder. `most` is the greatest total size of the folder's files (bytes)."""
        self.folder, self.most = folder, most

    @classmethod
    def of_user(cls) -> "KeptCalibrations":
        """Return the calibrations in the user's cache."""
        folder = cache_folder()
        return cls(None if folder is None else folder / "calibrations")

    def find(self, wanted: Conditions) -> Preparation | None:
        """Return the preparation stored for these conditions, or None if no preparation is stored for them, or if the
        file cannot be used.
        """
        if self.folder is None:
            return None
        try:
            return _decoded(read_whole(_place(self.folder, wanted), LARGEST), wanted)
        except (InvalidInput, ValueError):
            return None

    def keep(self, conditions: Conditions, preparation: Preparation) -> None:
        """Store a preparation, replacing an earlier one for the same conditions. Then remove old files. Raises
        CannotWrite if the file cannot be written.
        """
        if self.folder is None:
            return
        try:
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            raise CannotWrite(f"the folder {self.folder} cannot be created: {error.strerror}") from None
        rest = conditions.line + b"\n" + packed(preparation)
        write_whole(_place(self.folder, conditions), sealed(MAGIC, VERSION, rest))
        self._trim()

    def files(self) -> list[Path]:
        """Return the files of the calibrations, the newest first."""
        if self.folder is None:
            return []
        dated = [(_written(path), path) for path in self.folder.glob(f"[0-9a-f]*{ENDING}")]
        return [path for _, path in sorted(dated, reverse=True)]

    def entries(self) -> Iterator[KeptCalibration]:
        """Yield the readable calibrations, the newest first."""
        for path in self.files():
            with suppress(InvalidInput, ValueError):
                line = read_whole(path, LARGEST).split(b"\n", 2)[1:2]
                conditions = msgspec.json.decode(b"".join(line), type=Conditions)
                yield KeptCalibration(
                    file=path.name,
                    bytes=_size(path),
                    age_s=round(max(0.0, time.time() - _written(path)), 1),
                    task=conditions.task,
                    world=conditions.world,
                    camera=conditions.camera,
                )

    def clear(self) -> int:
        """Remove all calibrations, but no other files. Returns the number of calibrations removed."""
        files = self.files()
        for path in (*files, *self._unfinished()):
            _remove(path)
        return len(files)

    def _trim(self) -> None:
        """Remove the oldest files until all remaining files together are within the limit. Also remove unfinished
        files whose writer has ended.
        """
        together = 0
        for path in self.files():
            together += _size(path)
            if together > self.most:
                _remove(path)
        for path in self._unfinished():
            if time.time() - _written(path) > _ABANDONED_S:
                _remove(path)

    def _unfinished(self) -> Iterator[Path]:
        """Yield files that are still being written, or whose writer was killed."""
        return iter(()) if self.folder is None else self.folder.glob(f".[0-9a-f]*{ENDING}.*")


def _place(folder: Path, conditions: Conditions) -> Path:
    return folder / f"{hashlib.sha256(conditions.line).hexdigest()[:32]}{ENDING}"


def _decoded(data: bytes, wanted: Conditions) -> Preparation:
    """Return the preparation in a file. Raises ValueError if the preparation was made under other conditions."""
    line, _, rest = data.partition(b"\n")[2].partition(b"\n")
    if line != wanted.line or data != sealed(MAGIC, VERSION, line + b"\n" + rest):
        raise ValueError("the kept calibration is damaged, or was made under different conditions")
    return unpacked(rest, Preparation, LARGEST)


def _written(path: Path) -> float:
    """Return the time at which a file was written, in seconds since the epoch; 0 if the file no longer exists."""
    try:
        return path.lstat().st_mtime
    except OSError:
        return 0.0


def _size(path: Path) -> int:
    try:
        return path.lstat().st_size
    except OSError:
        return 0


def _remove(path: Path) -> None:
    with suppress(OSError):  # another process has removed the file, or the file may not be removed
        path.unlink()
