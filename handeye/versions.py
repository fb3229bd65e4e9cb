"""Versions that a result depends on besides its plan and its seed."""

import platform
from functools import cache
from typing import Final

HANDEYE: Final = "0.1.0"
PACKAGES: Final = ("mujoco", "numpy", "scipy", "opencv-python-headless")


def versions() -> dict[str, str]:
    """Versions of handeye, Python and the packages that figures pass through."""
    found = {name: _installed(name) for name in PACKAGES}
    return {"handeye": HANDEYE, "python": platform.python_version(), **found}


@cache
def _installed(package: str) -> str:
    """Version of a package. Read from its files once: every checkpoint says it again."""
    from importlib.metadata import version  # slow to import, and only a run needs it

    return version(package)
