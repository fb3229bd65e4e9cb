"""Finds what is shipped with the package, the folders `scenes`, `plans`, `demo` and `docs`, and the user's cache
folder."""

import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import Final

from handeye.core.errors import BadFile

_PACKAGE = Path(__file__).resolve().parents[1]
_ROOTS = (_PACKAGE / "_data", _PACKAGE.parent)  # in an installed wheel, and in a checkout of the repository


def folder(name: str) -> Path:
    """The folder `scenes`, `plans`, `demo` or `docs`; raises BadFile in an incomplete installation."""
    for root in _ROOTS:
        if (root / name).is_dir():
            return root / name
    raise BadFile(f"the folder `{name}` is missing from this installation of handeye")


def scenes() -> Path:
    """Models and dimensions, one folder a scene."""
    return folder("scenes")


def plans() -> Path:
    """Arm programs with their taught positions and compiled plans."""
    return folder("plans")


def demo() -> Path:
    """A recorded run of the water pump: a thinned trace, its result, and a picture of its end."""
    return folder("demo")


def docs() -> Path:
    """The pages of the documentation."""
    return folder("docs")


def page(name: str) -> str:
    """Where a page of the docs can be opened, by its path in the folder `docs`; that path if the docs are not here."""
    for root in _ROOTS:
        if (found := root / "docs" / name).is_file():
            with suppress(ValueError):
                return str(found.relative_to(Path.cwd()))
            return str(found)
    return f"docs/{name}"


VARIABLE: Final = "HANDEYE_CACHE"  # environment variable for another cache folder; empty disables caching


def cache_folder() -> Path | None:
    """The cache folder, which need not exist; None if caching is off or the user has no home."""
    named = os.environ.get(VARIABLE)
    if named is not None:
        return Path(named).absolute() if named else None
    try:
        return _of_the_platform()
    except RuntimeError:  # the home folder is unknown
        return None


def _of_the_platform() -> Path:
    if sys.platform == "win32":
        local = os.environ.get("LOCALAPPDATA")
        return (Path(local) if local else Path.home() / "AppData" / "Local") / "handeye" / "Cache"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "handeye"
    named = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (named if named.is_absolute() else Path.home() / ".cache") / "handeye"
