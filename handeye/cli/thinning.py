"""Command that thins the trace of a run."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import say
from handeye.cli.trace_files import TraceFile, trace_file
from handeye.core.errors import CannotWrite


def thin(
    file: TraceFile,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="The thinned trace, .mcap.")],
    overwrite: Annotated[bool, Parameter(help="Replace the trace that is there.")] = False,
) -> int:
    """Write a trace with no more of the motion than it takes to show the run, a tenth as large.

    It is a trace in its own right; only `verify` needs the whole one.
    """
    from handeye.core.files import check_free, check_place
    from handeye.trace.reading import TRACE, read_trace
    from handeye.trace.thinning import write_thinned

    whole = trace_file(file)
    trace = read_trace(whole)
    check_place(output, TRACE)
    if output.exists() and output.samefile(whole):
        raise CannotWrite(f"{output} holds the trace that is to be thinned")
    check_free(output, "trace", overwrite=overwrite)
    kept = write_thinned(trace, output)
    say(f"{output}: {kept} of {len(trace.times)} servo periods")
    return 0
