"""Trials that processes carry out in tests: functions that a new process can import."""

import os
import signal
import subprocess
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
    """Hang, at work, where nothing looks at a limit."""
    while item == "hung":
        pass
    return "done"


def paused(item: str) -> str:
    """Be stopped for longer than the limit of a trial, and go on."""
    goes_on = f"sleep .6; kill -CONT {os.getpid()}"
    with subprocess.Popen(["/bin/sh", "-c", goes_on]):
        os.kill(os.getpid(), signal.SIGSTOP)
    return item


def refused(item: int) -> int:
    """Raise an error for odd numbers."""
    if item % 2:
        raise InvalidInput(f"{item} is odd")
    return item
