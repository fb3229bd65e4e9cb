"""CPU seconds that commands take which move nothing, beside those of importing what every command rests on."""

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
"""What is checked: planning the pump's 189 motions takes half a second, however fast the command starts."""
MOST: Final = 1.6
"""Times that a command may take of the import."""
COMMANDS: Final = ("--version", "--help", "explain 23", "explain label-twice", "schema", "check job.al")


def starts(times: int) -> Iterator[tuple[str, float, float]]:
    """Each command with the CPU seconds of its fastest run, and those as a multiple of the fastest import's.

    Commands take turns, so that whatever else the machine does falls on all of them.
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
