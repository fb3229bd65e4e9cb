"""Measures the CPU seconds of commands that move nothing, compared with importing the libraries that every command
needs.
"""

import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Final

BASE: Final = "import numpy, cyclopts, rich.console, msgspec"
SCRIPT: Final = "OPEN 1\nCLOSE\n"
"""The script for `check`. It is short, because planning the pump's 189 motions would take half a second."""
MOST: Final = 1.6
"""Greatest permitted time of a command, as a multiple of the time of the import."""
COMMANDS: Final = ("--version", "--help", "explain 23", "explain label-twice", "schema", "check job.al")


def starts(times: int) -> Iterator[tuple[str, float, float]]:
    """Yield each command, the CPU seconds of its fastest run, and this time divided by that of the fastest import.

    Commands take turns, so that other work on the computer affects all of them.
    """
    calls = {"": ["-c", BASE], **{each: ["-m", "handeye", *each.split()] for each in COMMANDS}}
    with tempfile.TemporaryDirectory(prefix="handeye-") as name:
        (Path(name) / "job.al").write_text(SCRIPT, encoding="utf-8")
        rounds = [{each: _cpu_s(call, name) for each, call in calls.items()} for _ in range(times)]
    fastest = {each: min(one[each] for one in rounds) for each in calls}
    for each in COMMANDS:
        yield each, fastest[each], fastest[each] / fastest[""]


def _cpu_s(call: list[str], folder: str) -> float:
    compiled = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *call], cwd=folder, env=compiled, capture_output=True, check=True)  # noqa: S603
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
