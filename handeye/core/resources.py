"""Finds the folders shipped with the package: `scenes`, `plans` and `demo`."""

from pathlib import Path

from handeye.core.errors import BadFile

_PACKAGE = Path(__file__).resolve().parents[1]
_ROOTS = (_PACKAGE / "_data", _PACKAGE.parent)
"""In an installed wheel, and in a checkout of the repository."""


def folder(name: str) -> Path:
    """The folder `scenes`, `plans` or `demo`; raises BadFile in an incomplete installation."""
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
