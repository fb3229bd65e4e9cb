"""Writes folders completely or not at all, and never replaces a folder of another kind."""

import os
import shutil
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from handeye.core.diagnostics import quoted
from handeye.core.errors import CannotWrite, Taken
from handeye.core.files import settle, temporary_beside


@dataclass(frozen=True, slots=True, kw_only=True)
class FolderKind:
    """A kind of folder that this program writes."""

    name: str  # with its article
    known_by: str  # the file that identifies it
    begins: bytes  # start of that file
    holds: tuple[str, ...]  # patterns of all its file names


def check_folder(path: Path, kind: FolderKind, *, overwrite: bool) -> None:
    """Check that a folder of the kind `kind` can be written at `path`. Raises CannotWrite if the folder cannot be
    written, or Taken if there is already a folder at `path` that must not be replaced.
    """
    try:
        _refuse_others(path, kind, overwrite=overwrite)
        with tempfile.TemporaryFile(dir=Path(os.path.realpath(path)).parent):
            pass
    except OSError as error:
        raise CannotWrite(f"{path} cannot be written: {error.strerror}") from None


def _refuse_others(path: Path, kind: FolderKind, *, overwrite: bool) -> None:
    if path.exists() and not path.is_dir():
        raise CannotWrite(f"{path} is not a folder")
    inside = sorted(
        place.relative_to(path) for place in path.rglob("*") if not place.is_dir() or place.is_symlink()
    )
    known = path / kind.known_by
    ours = known.is_file() and known.read_bytes().startswith(kind.begins)
    kinds = [(pattern, len(Path(pattern).parts)) for pattern in kind.holds] if ours else []
    others = [n for n in inside if not any(n.match(p) and len(n.parts) == depth for p, depth in kinds)]
    if others:
        what = quoted(str(others[0]))
        raise CannotWrite(f"{path} holds other files ({what}); choose a new folder, or an empty one")
    if inside and not overwrite:
        raise Taken(f"{path} already holds {kind.name}; --overwrite replaces it")
    if path.exists() and path.samefile(Path.cwd()):
        raise CannotWrite(f"{path} is the current folder, which cannot be replaced; choose another folder")


def write_folder(path: Path, files: Mapping[str, bytes]) -> None:
    """Replace a folder atomically by a folder that contains `files`. If writing fails, the old folder stays."""

    def fill(new: Path) -> None:
        for name, data in files.items():
            _write(new / name, data)

    fill_folder(path, fill)


def fill_folder(path: Path, fill: Callable[[Path], None]) -> None:
    """Replace a folder atomically. `fill` makes the new folder at the path that it is given. If `fill` fails, the old
    folder stays.
    """
    place = Path(os.path.realpath(path))
    temporary = None
    try:
        temporary = Path(tempfile.mkdtemp(dir=place.parent, prefix=temporary_beside(place)))
        fill(temporary / "new")
        if place.exists():
            place.rename(temporary / "old")
        _put(temporary, place)
    except OSError as error:
        raise CannotWrite(f"{path} cannot be written: {error.strerror}") from None
    finally:  # after Ctrl-C too
        if temporary is not None:
            shutil.rmtree(temporary, ignore_errors=True)


def _put(temporary: Path, place: Path) -> None:
    """Put the new folder in its place by renaming it. If the renaming fails, restore the old folder."""
    try:
        (temporary / "new").rename(place)
    except BaseException:
        if (temporary / "old").exists():
            (temporary / "old").rename(place)
        raise


def _write(file: Path, data: bytes) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("wb") as whole:
        whole.write(data)
        whole.flush()
        settle(whole.fileno())
