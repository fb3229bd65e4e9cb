"""Versions that a result depends on besides its plan and its seed."""

import platform
from typing import Final

HANDEYE: Final = "0.1.0"
PACKAGES: Final = ("mujoco", "numpy", "scipy", "opencv-python-headless")


def versions() -> dict[str, str]:
    """Versions of handeye, Python and the packages that figures pass through."""
    from importlib.metadata import version as installed  # slow to import, and only a run needs it

    found = {name: installed(name) for name in PACKAGES}
    return {"handeye": HANDEYE, "python": platform.python_version(), **found}
