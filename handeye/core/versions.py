"""Versions that a result depends on besides its plan and its seed."""

import hashlib
import platform
from functools import cache
from pathlib import Path
from typing import Final

from handeye.core.resources import scenes

HANDEYE: Final = "0.1.0"
PACKAGES: Final = ("mujoco", "numpy", "scipy", "opencv-python-headless")


def versions() -> dict[str, str]:
    """Versions of handeye, Python and the packages that figures pass through."""
    found = {name: _installed(name) for name in PACKAGES}
    return {"handeye": HANDEYE, "python": platform.python_version(), **found}


def installed(package: str) -> str | None:
    """Version of a package, or None if it is not installed."""
    try:
        return _installed(package)
    except ImportError:
        return None


@cache
def _installed(package: str) -> str:
    """Version of a package. Read from its files once: every checkpoint says it again."""
    from importlib.metadata import version  # slow to import, and only a run needs it

    return version(package)


@cache
def code_digest() -> str:
    """Sixteen hexadecimal digits that stand for this program and its scenes, as they are on disk."""
    package = Path(__file__).resolve().parents[1]
    files = [(package, path) for path in package.rglob("*.py")]
    files += [(scenes(), path) for path in scenes().rglob("*") if path.is_file()]
    digest = hashlib.sha256()
    for name, path in sorted((path.relative_to(root).as_posix(), path) for root, path in files):
        digest.update(f"{name} ".encode() + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()[:16]
