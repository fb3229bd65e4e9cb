"""Versions that a result depends on besides its plan and its seed."""

import platform
from importlib.metadata import version as installed
from typing import Final

from handeye import __version__

PACKAGES: Final = ("mujoco", "numpy", "scipy", "opencv-python-headless")


def versions() -> dict[str, str]:
    """Versions of handeye, Python and the packages that figures pass through."""
    found = {name: installed(name) for name in PACKAGES}
    return {"handeye": __version__, "python": platform.python_version(), **found}
