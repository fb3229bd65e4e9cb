"""Command that compares two runs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, TaskWords, note, put_json, say
from handeye.cli.programs import made_known
from handeye.cli.reports import read_recorded
from handeye.cli.trace_files import TraceFile
from handeye.core.errors import InvalidInput

if TYPE_CHECKING:
    from handeye.comparison.comparison import Comparison
    from handeye.comparison.page import Animations
    from handeye.report.recorded import Recorded


def compare(
    a: TraceFile,
    b: TraceFile,
    /,
    *,
    task: TaskWords = None,
    output: Annotated[
        Path | None,
        Parameter(name=["--output", "-o"], help="A page with both views under one slider, .html."),
    ] = None,
    overwrite: Annotated[bool, Parameter(help="Replace the page that is there.")] = False,
    json: Json = False,
) -> int:
    """Compare two runs, step by step: what went otherwise first, where each searched, felt and corrected.

    Runs of different plans, scenes or worlds are compared as far as they go.

    Exit code 0: they are compared, whatever was found; 2: bad input.
    """
    from handeye.comparison.comparison import as_json, comparison
    from handeye.comparison.text import comparison_text

    made_known(task)
    if output is None:
        found = comparison(read_recorded(a), read_recorded(b))
    else:
        found = write_comparison(a, b, output, overwrite=overwrite)
        note(f"its page: {output}")
    if json:
        put_json(as_json(found))
    else:
        for line in comparison_text(found):
            say(line)
    return 0


def write_comparison(a: Path, b: Path, place: Path, *, overwrite: bool) -> "Comparison":
    """Write the page of two runs, by their folders or traces; what it shows; raises InvalidInput if there is no such
    run, they cannot be compared, or the page cannot be written there.

    Args:
        overwrite: a page of two runs that is there may be replaced.
    """
    from handeye.comparison.comparison import comparison
    from handeye.comparison.page import PAGE, comparison_page
    from handeye.core.files import check_free, check_place, write_over

    check_place(place, PAGE)
    check_free(place, "comparison", overwrite=overwrite)
    one, other = read_recorded(a), read_recorded(b)
    found = comparison(one, other)
    write_over(place, comparison_page(one, other, found, _animations(one, other)), PAGE)
    return found


def _animations(a: "Recorded", b: "Recorded") -> "Animations | str":
    """What is shown of both runs to walk round in, or why there is nothing."""
    from handeye.report.animation import animation
    from handeye.report.facts.scene import check_scene

    made = []
    for run in (a, b):
        try:
            check_scene(run)
            shown = animation(run)
        except InvalidInput as fault:
            return f"{fault}."
        if shown is None:
            return f"{run.trace.name} holds no motion."
        made.append(shown)
    one, other = made
    return one, other
