"""Calibrations that are kept for other runs: files in the user's cache, each found by all that it depends on.

What cannot be used is done again and replaced. Each is written whole or not at all, so that processes may write at
once: equal conditions make equal bytes.
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
from handeye.core.user_cache import cache_folder
from handeye.core.variation import WorldSpec
from handeye.ports.camera import Renderer
from handeye.systems.stanford.conditions import Conditions
from handeye.systems.stanford.preparation import Preparation

MAGIC: Final = "handeye-calibration"
VERSION: Final = 1
ENDING: Final = ".calibration"
LARGEST: Final = 1 << 20
"""Bytes of one, also unpacked: many times what the water pump's has."""
MOST: Final = 1 << 24
"""Bytes of all; beyond, the oldest go."""
_ABANDONED: Final = 3600.0
"""s after which a file that nobody has finished is nobody's any more."""


class Kept(Record, frozen=True, kw_only=True):
    """A kept calibration, as people are told of it."""

    file: str
    bytes: int
    age_s: float
    task: str
    world: WorldSpec
    camera: Renderer


class KeptCalibrations:
    """The calibrations in a folder; without a folder none is found and none is kept."""

    def __init__(self, folder: Path | None, most: int = MOST) -> None:
        """`most`: bytes that they may have together."""
        self.folder, self.most = folder, most

    @classmethod
    def of_user(cls) -> "KeptCalibrations":
        """Those in this user's cache."""
        folder = cache_folder()
        return cls(None if folder is None else folder / "calibrations")

    def find(self, wanted: Conditions) -> Preparation | None:
        """A preparation under these conditions; None if none is kept, or what is there cannot be used."""
        if self.folder is None:
            return None
        try:
            return _decoded(read_whole(_place(self.folder, wanted), LARGEST), wanted)
        except (InvalidInput, ValueError):
            return None

    def keep(self, conditions: Conditions, preparation: Preparation) -> None:
        """Keep a preparation, in the place of an earlier one; the oldest go if there are too many.

        Raises:
            InvalidInput: the folder cannot be written.
        """
        if self.folder is None:
            return
        try:
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        except OSError as error:
            raise CannotWrite(f"{self.folder} cannot be made: {error.strerror}") from None
        rest = conditions.line + b"\n" + packed(preparation)
        write_whole(_place(self.folder, conditions), sealed(MAGIC, VERSION, rest))
        self._trim()

    def files(self) -> list[Path]:
        """Their files, the newest first."""
        if self.folder is None:
            return []
        dated = [(_written(path), path) for path in self.folder.glob(f"[0-9a-f]*{ENDING}")]
        return [path for _, path in sorted(dated, reverse=True)]

    def entries(self) -> Iterator[Kept]:
        """What is known of each, the newest first; of what cannot be read nothing is told."""
        for path in self.files():
            with suppress(InvalidInput, ValueError):
                line = read_whole(path, LARGEST).split(b"\n", 2)[1:2]
                told = msgspec.json.decode(b"".join(line), type=Conditions)
                yield Kept(
                    file=path.name,
                    bytes=_size(path),
                    age_s=round(max(0.0, time.time() - _written(path)), 1),
                    task=told.task,
                    world=told.world,
                    camera=told.camera,
                )

    def clear(self) -> int:
        """Remove all of them, and nothing else; how many there were."""
        found = self.files()
        for path in (*found, *self._unfinished()):
            _remove(path)
        return len(found)

    def _trim(self) -> None:
        """Remove the oldest of too many, and what a process that was killed has left."""
        together = 0
        for path in self.files():
            together += _size(path)
            if together > self.most:
                _remove(path)
        for path in self._unfinished():
            if time.time() - _written(path) > _ABANDONED:
                _remove(path)

    def _unfinished(self) -> Iterator[Path]:
        """Files that somebody is writing, or was."""
        return iter(()) if self.folder is None else self.folder.glob(f".[0-9a-f]*{ENDING}.*")


def _place(folder: Path, conditions: Conditions) -> Path:
    return folder / f"{hashlib.sha256(conditions.line).hexdigest()[:32]}{ENDING}"


def _decoded(data: bytes, wanted: Conditions) -> Preparation:
    """The preparation in a file. Raises ValueError unless it is one under these conditions."""
    line, _, rest = data.partition(b"\n")[2].partition(b"\n")
    if line != wanted.line or data != sealed(MAGIC, VERSION, line + b"\n" + rest):
        raise ValueError("it is damaged, or of other conditions")
    return unpacked(rest, Preparation, LARGEST)


def _written(path: Path) -> float:
    """When a file was written; 0 if it has just gone."""
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
    with suppress(OSError):  # another process was quicker, or it is not ours to remove
        path.unlink()
