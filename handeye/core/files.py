"""Files are read if they are files of a sensible size, and written whole or not at all."""

import os
import re
import stat
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from handeye.core.errors import BadFile, CannotWrite

LARGEST: Final = 1 << 30
"""Bytes: a hundred times what the trace of a whole run takes."""

_FRONT: Final = 1024
"""Bytes of a file by which it is known."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of file that this program writes where somebody says."""

    name: str
    begins: bytes
    """How each of them begins: a regular expression."""
    ending: str = ""
    """Ending that its name must have, if other programs go by that."""


def read_whole(path: str | Path, largest: int = LARGEST) -> bytes:
    """Content of a file."""
    file = Path(path)
    try:
        if not file.exists():
            raise BadFile(f"{path}: there is no such file")
        if file.is_dir():
            raise BadFile(f"{path} is a directory, not a file")
        if not file.is_file():
            raise BadFile(f"{path} is a device or a pipe, not a file")
        size = file.stat().st_size
        if size > largest:
            raise BadFile(f"{path} has {size} bytes; the limit is {largest}")
        return file.read_bytes()
    except (OSError, ValueError) as error:  # ValueError: a name with a NUL in it
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise BadFile(f"{path} cannot be read: {reason}") from None


def beside(path: Path, ending: str) -> Path:
    """The file of the same name with another ending."""
    if not path.name:
        raise CannotWrite(f"{path} is a directory, not a file")
    return path.with_suffix(ending)


def check_place(path: Path, kind: Kind) -> None:
    """Look whether a file of a kind may be written, and can be: it replaces none of another kind."""
    if not path.name.lower().endswith(kind.ending):
        raise CannotWrite(f"{path}: the name of the {kind.name} must end in {kind.ending}")
    try:
        _check_file(path, path)
        if path.exists():
            with path.open("rb") as file:
                front = file.read(_FRONT)
            if front and not re.match(kind.begins, front):
                raise CannotWrite(f"{path} exists and is no {kind.name}; nothing was written")
        with tempfile.TemporaryFile(dir=Path(os.path.realpath(path)).parent):
            pass
    except OSError as error:
        raise CannotWrite(f"{path} cannot be written: {error.strerror}") from None


def check_free(path: Path, what: str, *, overwrite: bool) -> None:
    """Look whether there is nothing at a place yet, or what it holds may be replaced."""
    if path.exists() and not overwrite:
        raise CannotWrite(f"{path} holds a {what} already; --overwrite replaces it")


def write_over(path: Path, data: bytes, kind: Kind) -> None:
    """Write a file of a kind, as `write_whole`, where `check_place` has nothing against it."""
    check_place(path, kind)
    write_whole(path, data)


def write_whole(path: Path, data: bytes) -> None:
    """Write `data` beside `path`, then put it in its place in one act. What a link leads to is written, and who may
    read a file that was there may still.
    """
    temporary = None
    place = Path(os.path.realpath(path))
    try:
        _check_file(place, path)
        mode = stat.S_IMODE(place.stat().st_mode) if place.exists() else 0o666 & ~_umask()
        handle, temporary = tempfile.mkstemp(dir=place.parent, prefix=f".{place.name}.")
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(temporary, mode)
        os.replace(temporary, place)
    except BaseException as error:  # Ctrl-C too
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise CannotWrite(f"{path} cannot be written: {error.strerror}") from None
        raise


def _check_file(place: Path, named: Path) -> None:
    if place.exists() and not place.is_file():
        raise CannotWrite(f"{named} cannot be written: it is not a file")


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
