"""Two recorded runs are compared."""

import os
from pathlib import Path

from handeye.api.trace import open
from handeye.comparison.comparison import Comparison, comparison
from handeye.report.recorded import Recorded
from handeye.results.recorded_run import recorded_run
from handeye.trace.trace import Trace


def compare(a: str | os.PathLike[str] | Trace, b: str | os.PathLike[str] | Trace) -> Comparison:
    """Compare two recorded runs, step by step; printed, it is what `handeye compare` says.

    Args:
        a: the folder of a run that has ended, a `trace.mcap`, or an open trace.
        b: likewise.

    Raises:
        InvalidInput: a run cannot be read, or cannot be compared.

    >>> for seed in 1, 2:
    ...     run = handeye.assemble(seed, script="OPEN 1\\nCLOSE .1\\n", camera="ray", out=folder / str(seed))
    >>> found = handeye.compare(folder / "1", folder / "2")
    >>> found.same, found.first.place.text, found.parted
    (False, 'OPEN 1', None)
    """
    return comparison(_recorded(a), _recorded(b))


def _recorded(run: str | os.PathLike[str] | Trace) -> Recorded:
    if isinstance(run, Trace):
        return Recorded(trace=run)
    trace = open(run)
    return recorded_run(Path(run), trace)
