"""Traces are opened."""

import os

from handeye.api.arguments import given_file
from handeye.runs.folder import TRACE
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace


def open(path: str | os.PathLike[str]) -> Trace:
    """Read the trace of a run that has ended: a `trace.mcap`, or the folder of the run.

    Raises:
        InvalidInput: it cannot be read, or is not a sound trace.

    >>> run = handeye.assemble(script="OPEN 1\\n", camera="ray", out=folder)
    >>> handeye.open(folder).head.program
    'script'
    """
    file = given_file(path, "a trace is a file or the folder of a run")
    return read_trace(file / TRACE if file.is_dir() else file)
