"""Trials that processes carry out in tests: functions that a new process can import."""

import os
import signal
import threading
from pathlib import Path

from handeye.core.errors import InvalidInput


def process(item: object) -> tuple[object, int]:
    """Tell in which process an item was tried."""
    return item, os.getpid()


def killed_once(item: Path) -> str:
    """Have the process killed, the first time that the item is tried."""
    if item.exists():
        return "tried again"
    item.touch()
    return killed_always(item)


def killed_always(item: Path) -> str:
    """Have the process killed where the item is named for that."""
    if item.name != "well":
        os.kill(os.getpid(), signal.SIGKILL)
    return "done"


def hung(item: str) -> str:
    """Hang where nobody asks for the time."""
    if item == "hung":
        threading.Event().wait()
    return "done"


def refused(item: int) -> int:
    """Raise an error for odd numbers."""
    if item % 2:
        raise InvalidInput(f"{item} is odd")
    return item
