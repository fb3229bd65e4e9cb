"""Finds the folders included with handeye (`scenes`, `plans`, `demo`, `docs`) and the user's cache folder."""

import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import Final

from handeye.core.errors import BadFile

_PACKAGE = Path(__file__).resolve().parents[1]
_ROOTS = (_PACKAGE / "_data", _PACKAGE.parent)  # in an installed wheel, and in a checkout of the repository


def folder(name: str) -> Path:
    """The path of the folder `scenes`, `plans`, `demo` or `docs`; raises BadFile if the installation is incomplete."""
    for root in _ROOTS:
        if (root / name).is_dir():
            return root / name
    raise BadFile(f"the folder `{name}` is missing from this installation of handeye")


def scenes() -> Path:
    """The folder of models and dimensions, with one folder per scene."""
    return folder("scenes")


def plans() -> Path:
    """The folder of arm programs with their taught positions and compiled plans."""
    return folder("plans")


def demo() -> Path:
    """The folder of a recorded run of the water pump: a thinned trace, the result, and a picture of the end."""
    return folder("demo")


def docs() -> Path:
    """The folder of the documentation."""
    return folder("docs")


def page(name: str) -> str:
    """The address of a page of the documentation; `name` is its path in the folder `docs`. The name itself if that
    folder is missing.
    """
    for root in _ROOTS:
        if (found := root / "docs" / name).is_file():
            with suppress(ValueError):
                return str(found.relative_to(Path.cwd()))
            return str(found)
    return f"docs/{name}"


VARIABLE: Final = "HANDEYE_CACHE"  # environment variable for another cache folder; empty disables caching


def cache_folder() -> Path | None:
    """The path of the cache folder, which may not exist; None if caching is off or the user has no home folder."""
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
