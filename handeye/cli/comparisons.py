"""Command that compares two runs."""

from cyclopts import App

from handeye.cli.common import Json, put_json, say
from handeye.cli.trace_files import TraceFile


def register(app: App) -> None:
    """Add the command to the command line."""
    app.command(compare)


def compare(a: TraceFile, b: TraceFile, /, *, json: Json = False) -> int:
    """Compare two runs, step by step: what went otherwise first, where each searched, felt and corrected.

    Runs of different plans, scenes or worlds are compared as far as they go.

    Exit code 0: they are compared, whatever was found; 2: bad input.
    """
    from handeye.cli.reports import read_recorded
    from handeye.comparison.comparison import as_json, comparison
    from handeye.comparison.text import comparison_text

    found = comparison(read_recorded(a), read_recorded(b))
    if json:
        put_json(as_json(found))
    else:
        for line in comparison_text(found):
            say(line)
    return 0
