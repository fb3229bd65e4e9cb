"""Command that makes a page of a run."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import TaskWords, note, say
from handeye.cli.programs import made_known
from handeye.cli.trace_files import TraceFile, motion_file
from handeye.core.errors import BadArgument

if TYPE_CHECKING:
    from handeye.report.recorded import Recorded


DEMO: Final = "demo.html"
"""The page of the run that comes with handeye, if nobody says otherwise."""


def report(
    run: TraceFile | None = None,
    other: Annotated[
        Path | None, Parameter(help="A second run: the page compares the two, as `compare -o` does.")
    ] = None,
    /,
    *,
    task: TaskWords = None,
    output: Annotated[
        Path | None,
        Parameter(
            name=["--output", "-o"],
            help="The page, .html; by default report.html in the folder of the run, or beside the trace; of `--demo` "
            "demo.html here.",
        ),
    ] = None,
    overwrite: Annotated[bool, Parameter(help="Replace the report that is there.")] = False,
    demo: Annotated[
        bool, Parameter(negative="", help="Of a run that comes with handeye; nothing has to be carried out.")
    ] = False,
) -> int:
    """Make a page of a run, or of two: one file with what happened, why, and what was seen and felt.

    Exit code 0: it is written, whatever the run came to; 2: bad input.
    """
    from handeye.cli.comparisons import write_comparison
    from handeye.core import resources

    made_known(task)
    if (run is None) != demo or (demo and other is not None):
        raise BadArgument("a report is of one run: give its folder or its trace, or --demo")
    if run is None:
        place = output or Path(DEMO)
        write_report(resources.demo(), place, overwrite=overwrite)
        note(f"open {place} in a browser")
    elif other is not None:
        if output is None:
            raise BadArgument("a page of two runs belongs to neither; say with -o where it is to be written")
        place = output
        write_comparison(run, other, place, overwrite=overwrite)
    else:
        place = output or _beside(run)
        write_report(run, place, overwrite=overwrite)
    say(str(place))
    return 0


def _beside(run: Path) -> Path:
    """Where the report of a run is left if nobody says: in its folder, or beside its trace."""
    from handeye.runs.folder import REPORT

    return run / REPORT if run.is_dir() else run.with_name(REPORT)


def write_report(run: Path, place: Path, *, overwrite: bool) -> None:
    """Write the report of a run; raises InvalidInput if there is no such run, or the report cannot be written there.

    Args:
        run: its folder, or its trace.
        overwrite: a report that is there may be replaced.
    """
    from handeye.core.files import check_free, check_place, write_over
    from handeye.report.page.document import REPORT

    check_place(place, REPORT)
    check_free(place, "report", overwrite=overwrite)
    write_over(place, page_of(run), REPORT)


def page_of(run: Path) -> bytes:
    """The page of the run in a folder or a trace; raises InvalidInput if there is none, or an older handeye recorded
    it.
    """
    from handeye.core.entries import entry_named
    from handeye.report.animation import animation
    from handeye.report.facts.scene import check_scene
    from handeye.report.page.account_page import account_page
    from handeye.report.page.document import report_page
    from handeye.report.photographs import album
    from handeye.runs.systems import system_of_files

    own = system_of_files(run)
    if own is not None and (page := own.page(run)) is not None:
        return page
    recorded = read_recorded(run)
    if "plans" not in entry_named(recorded.trace.head.system).can:
        return account_page(recorded)
    check_scene(recorded)
    return report_page(recorded, album(recorded), animation(recorded))


def read_recorded(run: Path) -> "Recorded":
    """The run in a folder or a trace, as far as it can be read; raises InvalidInput if there is none."""
    from handeye.results.recorded_run import recorded_run
    from handeye.trace.reading import is_cut_short, read_trace

    file = motion_file(run)
    cut = is_cut_short(file)
    return recorded_run(run, read_trace(file, lenient=cut), whole=not cut)
