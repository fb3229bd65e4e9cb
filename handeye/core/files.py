"""Reads files of limited size, writes files completely or not at all, and appends lines."""

import errno
import os
import re
import stat
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from handeye.core.errors import BadFile, CannotWrite, InvalidInput, Taken
from handeye.core.plain_text import counted

LARGEST: Final = 1 << 30  # bytes: a hundred traces of a whole run
_CANNOT: Final = {
    errno.EINVAL,
    errno.ENOSYS,
    errno.ENOTSUP,
    errno.EOPNOTSUPP,
}  # errors from a file system that lacks the operation
_NOWHERE: Final = {errno.ENOENT, errno.ENOTDIR, errno.ENAMETOOLONG}
_OF_NAME: Final = 40
"""Number of characters of a file's name that are repeated in the name of its temporary file. With more characters, the
temporary name could exceed the limit of the file system.
"""

_FRONT: Final = 1024  # bytes that identify a file


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of file that this program writes."""

    name: str
    begins: bytes  # a regular expression
    ending: str = ""  # required ending of the name, if any

    @property
    def with_article(self) -> str:
        """The name with its article, such as `an SVG drawing`."""
        return f"{'an' if self.name.startswith(('MP4', 'SVG')) else 'a'} {self.name}"


def page_kind(name: str, mark: str) -> Kind:
    """Return the kind of file for web pages that begin with the text `mark`. Pages of earlier versions, which have
    `doctype` in lower case, are of this kind too.
    """
    return Kind(name, mark.replace("DOCTYPE", "(?i:doctype)").encode(), ending=".html")


def read_whole(path: str | Path, largest: int = LARGEST) -> bytes:
    """Read a whole file. Raises BadFile if the file is missing, not a regular file, larger than `largest` bytes, or
    unreadable.
    """
    file = Path(path)
    try:
        if not file.exists():
            if file.is_symlink():
                raise BadFile(f"{path} is a broken link")
            raise BadFile(f"{path}: there is no such file")
        if file.is_dir():
            raise BadFile(f"{path} is a directory, not a file")
        if not file.is_file():
            raise BadFile(f"{path} is a device or a pipe, not a file")
        size = file.stat().st_size
        if size > largest:
            raise BadFile(f"{path} has {counted(size, 'byte')}; the limit is {largest}")
        return file.read_bytes()
    except (OSError, ValueError) as error:  # ValueError: a name with a NUL in it
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise BadFile(f"{path} cannot be read: {reason}") from None


def beside(path: Path, ending: str) -> Path:
    """Return the path with its ending replaced by `ending`. Raises CannotWrite if the path is a directory."""
    if not path.name:
        raise CannotWrite(f"{path} is a directory, not a file")
    return path.with_suffix(ending)


def is_there(path: Path) -> bool:
    """Return True if a path exists, even as a link to a missing file. Raises BadFile if this cannot be determined."""
    try:
        path.lstat()
    except ValueError:  # a name with a NUL in it
        return False
    except OSError as error:
        if error.errno in _NOWHERE:  # for example, because no file can have this name
            return False
        raise BadFile(f"{path} cannot be read: {error.strerror}") from None
    return True


def temporary_beside(place: Path) -> str:
    """Return the beginning of the name of the temporary file or folder that will replace `place`."""
    return f".{place.name[:_OF_NAME]}."


def settle(file: int) -> None:
    """Flush a file descriptor to the disk, if the file system supports it."""
    try:
        os.fsync(file)
    except OSError as error:
        if error.errno not in _CANNOT:
            raise


def check_place(path: Path, kind: Kind, *, overwrite: bool = True) -> None:
    """Check that a file of the kind `kind` can be written at `path` without replacing a file of another kind.

    Raises:
        CannotWrite: the file cannot be written at `path`.
        Taken: a file of this kind exists, and `overwrite` is False.
    """
    if not path.name.lower().endswith(kind.ending):
        raise CannotWrite(f"{path}: the name of the {kind.name} must end in {kind.ending}")
    try:
        _check_file(path, path)
        if path.exists():
            with path.open("rb") as file:
                front = file.read(_FRONT)
            if front and not re.match(kind.begins, front):
                raise CannotWrite(f"{path} exists and is not {kind.with_article}; nothing was written")
            if front and not overwrite:
                raise Taken(f"{path} already exists; --overwrite replaces it")
        from tempfile import TemporaryFile  # slow to import, and nothing that only reads needs it

        with TemporaryFile(dir=Path(os.path.realpath(path)).parent):
            pass
    except OSError as error:
        raise CannotWrite(f"{path} cannot be written: {error.strerror}") from None


def check_new(path: Path) -> None:
    """Raise Taken if the path exists. Typed commands use this check, because they have no option `--overwrite`."""
    if path.exists():
        raise Taken(f"{path} already exists; nothing was written, choose another name")


def write_over(path: Path, data: bytes, kind: Kind) -> None:
    """Check the place with `check_place`, then write the file with `write_whole`."""
    check_place(path, kind)
    write_whole(path, data)


def write_whole(path: Path, data: bytes) -> None:
    """Write a file atomically. Symbolic links are followed, an existing file keeps its mode, and no temporary file
    stays behind after a failure.
    """
    temporary = None
    place = Path(os.path.realpath(path))
    try:
        _check_file(place, path)
        os.umask(umask := os.umask(0))
        mode = stat.S_IMODE(place.stat().st_mode) if place.exists() else 0o666 & ~umask
        from tempfile import mkstemp

        handle, temporary = mkstemp(dir=place.parent, prefix=temporary_beside(place))
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            settle(file.fileno())
        with suppress(OSError):  # of a file system without modes
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


def unguarded(path: Path, why: str) -> str:
    """Return a warning that a file cannot be locked. `why` is the reason that the file system gives."""
    return f"{path} cannot be locked ({why}): make sure that no other command writes to it"


class LineFile:
    """A file to which whole lines are appended, by one writer at a time."""

    def __init__(self, path: Path, writer: str, *, again: bool = True) -> None:
        """Open a file to append lines. An incomplete last line is cut off. If `again` is False, all earlier lines are
        deleted. Raises CannotWrite if another process has the file open; `writer` names that process in the error
        message.
        """
        self.path = path
        self.unlocked = ""
        """Reason why the file could not be locked; empty if the file is locked. Other processes can write to an
        unlocked file.
        """
        if path.exists() and not path.is_file():  # opening a pipe without a reader would wait for ever
            raise CannotWrite(f"{path} cannot be written: it is not a file")
        try:
            self._file = path.open("ab", buffering=0)
            self._lock(writer)
            text = path.read_bytes() if again else b""
            self._file.truncate(text.rfind(b"\n") + 1)
        except OSError as error:
            raise self._unwritable(error) from None

    def append(self, line: bytes) -> None:
        """Append a line, including its line end, completely or not at all. Raises CannotWrite if that fails."""
        try:
            whole = self._file.seek(0, os.SEEK_END)
            if self._file.write(line) < len(line):
                self._file.truncate(whole)  # half a line would spoil the next
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        except OSError as error:
            raise self._unwritable(error) from None

    def clear(self) -> None:
        self._file.truncate(0)

    def close(self) -> None:
        self._file.close()

    def _lock(self, writer: str) -> None:
        """Lock the file if the platform and the file system support locks. Raises CannotWrite if the file is already
        locked.
        """
        with suppress(ImportError):
            import fcntl

            try:
                fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                self._file.close()
                raise CannotWrite(f"{writer} is writing to {self.path} now") from None
            except OSError as error:
                self.unlocked = error.strerror or str(error)

    def _unwritable(self, error: OSError) -> InvalidInput:
        return CannotWrite(f"{self.path} cannot be written: {error.strerror}")
