"""Finds the folders that travel with the package: `scenes`, `plans` and `demo`."""

from pathlib import Path

from handeye.core.errors import BadFile

_PACKAGE = Path(__file__).resolve().parents[1]
_ROOTS = (_PACKAGE / "_data", _PACKAGE.parent)
"""Where an installed wheel keeps them, and where a checkout of the repository does."""


def folder(name: str) -> Path:
    """The folder `scenes`, `plans` or `demo`."""
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
    """A run of the water pump to be looked at: a thinned trace, its result, and a picture of its end."""
    return folder("demo")
