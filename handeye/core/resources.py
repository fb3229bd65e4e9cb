"""Finds the folders included with handeye (`scenes`, `plans`, `benches`, `demo`, `docs`) and the cache folder."""

import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import Final

from handeye.core.errors import BadFile

_PACKAGE = Path(__file__).resolve().parents[1]
_ROOTS = (_PACKAGE / "_data", _PACKAGE.parent)  # in an installed wheel, and in a checkout of the repository


def folder(name: str) -> Path:
    """Return the path of the folder `scenes`, `plans`, `benches`, `demo` or `docs`. Raises BadFile if the installation
    is incomplete.
    """
    for root in _ROOTS:
        if (root / name).is_dir():
            return root / name
    raise BadFile(f"the folder `{name}` is missing from this installation of handeye")


def scenes() -> Path:
    """Return the folder of models and dimensions, which has one folder for each scene."""
    return folder("scenes")


def plans() -> Path:
    """Return the folder of arm programs with their taught positions and compiled plans."""
    return folder("plans")


def benches() -> Path:
    """Return the folder of benches, with the tasks of the agents' bench."""
    return folder("benches")


def demo() -> Path:
    """Return the folder of a recorded run of the water pump: a thinned trace, the result, and a picture of the
    finished pump.
    """
    return folder("demo")


def recorded() -> tuple[str, ...]:
    """Return the names of further recorded runs, which are folders in the folder `demo`."""
    return tuple(sorted(result.parent.name for result in demo().glob("*/result.json")))


def docs() -> Path:
    """Return the folder of the documentation."""
    return folder("docs")


def page(name: str) -> str:
    """Return the address of a page of the documentation, or `name` itself if the folder `docs` is missing. `name`
    is the path of the page in that folder.
    """
    for root in _ROOTS:
        if (found := root / "docs" / name).is_file():
            with suppress(ValueError):
                return str(found.relative_to(Path.cwd()))
            return str(found)
    return f"docs/{name}"


VARIABLE: Final = "HANDEYE_CACHE"  # environment variable for another cache folder; empty disables caching


def cache_folder() -> Path | None:
    """Return the path of the cache folder, which may not exist yet, or None if caching is off or the user has no
    home folder.
    """
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
