"""The versions on which a result depends, in addition to the plan and the seed."""

from functools import cache
from pathlib import Path
from typing import Final

from handeye.core.resources import scenes

HANDEYE: Final = "0.1.0"
PACKAGES: Final = ("mujoco", "numpy", "scipy", "opencv-python-headless")


def versions() -> dict[str, str]:
    """Return the versions of handeye, Python and the packages on which results depend."""
    import platform

    found = {name: _installed(name) for name in PACKAGES}
    return {"handeye": HANDEYE, "python": platform.python_version(), **found}


def installed(package: str) -> str | None:
    """Return the version of a package, or None if the package is not installed."""
    try:
        return _installed(package)
    except ImportError:
        return None


@cache
def _installed(package: str) -> str:
    from importlib.metadata import version  # slow to import, and only a run needs it

    return version(package)


@cache
def code_digest() -> str:
    """Compute a digest (16 hexadecimal digits) of handeye's files and scenes on disk. Raises BadFile if one of these
    files cannot be read.
    """
    import hashlib

    package = Path(__file__).resolve().parents[1]
    files = [(package, path) for path in package.rglob("*.py")]
    files += [(scenes(), path) for path in scenes().rglob("*") if path.is_file()]
    digest = hashlib.sha256()
    for name, path in sorted((path.relative_to(root).as_posix(), path) for root, path in files):
        digest.update(f"{name} ".encode() + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()[:16]
