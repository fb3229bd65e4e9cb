"""Folders of files that are written whole or not at all, and take the place of nobody else's."""

import os
import shutil
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from handeye.core.diagnostics import quoted
from handeye.core.errors import CannotWrite, Taken


@dataclass(frozen=True, slots=True, kw_only=True)
class FolderKind:
    """A kind of folder that this program writes where somebody says."""

    name: str
    """With its article."""
    known_by: str
    """The file by which it is known."""
    begins: bytes
    """How that file begins."""
    holds: tuple[str, ...]
    """Patterns of the names of all its files."""


def check_folder(path: Path, kind: FolderKind, *, overwrite: bool) -> None:
    """Look whether a folder of a kind may be written, and can be: it takes the place of one of its kind at most."""
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
    others = [name for name in inside if not (ours and any(_fits(name, pattern) for pattern in kind.holds))]
    if others:
        what = quoted(str(others[0]))
        raise CannotWrite(f"{path} holds other things ({what}); choose a new folder, or an empty one")
    if inside and not overwrite:
        raise Taken(f"{path} holds {kind.name} already; --overwrite replaces it")
    if path.exists() and path.samefile(Path.cwd()):
        raise CannotWrite(f"{path} is the folder that you are in, which cannot be replaced; name another")


def _fits(name: Path, pattern: str) -> bool:
    return name.match(pattern) and len(name.parts) == len(Path(pattern).parts)


def write_folder(path: Path, files: Mapping[str, bytes]) -> None:
    """Write a folder of files beside `path`, then put it in its place; what was there is gone then."""
    place = Path(os.path.realpath(path))
    temporary = None
    try:
        temporary = Path(tempfile.mkdtemp(dir=place.parent, prefix=f".{place.name}."))
        for name, data in files.items():
            _write(temporary / "new" / name, data)
        if place.exists():
            place.rename(temporary / "old")
        _put(temporary, place)
    except OSError as error:
        raise CannotWrite(f"{path} cannot be written: {error.strerror}") from None
    finally:  # after Ctrl-C too
        if temporary is not None:
            shutil.rmtree(temporary, ignore_errors=True)


def _put(temporary: Path, place: Path) -> None:
    """Put the new folder into its place, or the old one back."""
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
        os.fsync(whole.fileno())
