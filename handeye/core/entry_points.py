"""Entry points of installed packages, at a fraction of what reading all their metadata costs."""

import sys
from pathlib import Path

FILE = "entry_points.txt"


def entry_points(group: str) -> dict[str, str]:
    """`module:NAME` of the entry points of a group, by name; `importlib.metadata` is asked where a package has one."""
    heading = f"[{group}]"
    if not any(heading in file.read_text("utf-8", "replace") for path in sys.path for file in _files(path)):
        return {}
    from importlib import metadata  # an eighth of the time that a short command takes

    return {point.name: point.value for point in metadata.entry_points(group=group)}


def _files(path: str) -> list[Path]:
    try:
        return [*Path(path).glob(f"*-info/{FILE}")]
    except OSError:
        return []
