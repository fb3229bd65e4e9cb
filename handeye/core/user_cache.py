"""The user's cache folder, by the convention of the platform."""

import os
import sys
from pathlib import Path
from typing import Final

VARIABLE: Final = "HANDEYE_CACHE"
"""Environment variable for another cache folder; empty disables caching."""


def cache_folder() -> Path | None:
    """The cache folder, which need not exist; None if caching is off or the user has no home."""
    named = os.environ.get(VARIABLE)
    if named is not None:
        return Path(named).absolute() if named else None
    try:
        return _of_the_platform()
    except RuntimeError:  # nobody knows where the home is
        return None


def _of_the_platform() -> Path:
    if sys.platform == "win32":
        local = os.environ.get("LOCALAPPDATA")
        return (Path(local) if local else Path.home() / "AppData" / "Local") / "handeye" / "Cache"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "handeye"
    named = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (named if named.is_absolute() else Path.home() / ".cache") / "handeye"
