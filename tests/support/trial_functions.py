"""Trials that processes execute in tests. They are functions that a new process can import."""

import os
import signal
import subprocess
from pathlib import Path

from handeye.core.errors import InvalidInput


def process(item: object) -> tuple[object, int]:
    """Return the process in which an item was tried."""
    return item, os.getpid()


def killed_once(item: Path) -> str:
    """Kill the process when the item is tried for the first time."""
    if item.exists():
        return "tried again"
    item.touch()
    return killed_always(item)


def killed_always(item: Path) -> str:
    """Kill the process each time, unless the item is called `well`."""
    if item.name != "well":
        os.kill(os.getpid(), signal.SIGKILL)
    return "done"


def hung(item: str) -> str:
    """Hang in busy code that checks no limit."""
    while item == "hung":
        pass
    return "done"


def paused(item: str) -> str:
    """Stop the process for longer than the limit of a trial, and then continue."""
    goes_on = f"sleep .6; kill -CONT {os.getpid()}"
    with subprocess.Popen(["/bin/sh", "-c", goes_on]):
        os.kill(os.getpid(), signal.SIGSTOP)
    return item


def refused(item: int) -> int:
    """Raise an error for odd numbers."""
    if item % 2:
        raise InvalidInput(f"{item} is odd")
    return item
