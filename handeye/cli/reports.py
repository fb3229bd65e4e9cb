"""Commands that show a run, make a page of it, or compare two runs."""

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Json, Overwrite, TaskWords, answer, note, say, screen
from handeye.cli.programs import made_known
from handeye.cli.trace_files import (
    Run,
    RunOrTrace,
    motion_file,
    run_or_newest,
    two_runs,
)
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, InvalidInput

if TYPE_CHECKING:
    from handeye.comparison.comparison import Comparison
    from handeye.comparison.page import Animations
    from handeye.report.recorded import RecordedRun
    from handeye.results.kept_run import KeptRun
    from handeye.results.result import Result

DEMO: Final = "demo.html"


def report(
    run: RunOrTrace = None,
    other: Annotated[
        Path | None, Parameter(help="A second run: the page then compares the two, like `compare -o`.")
    ] = None,
    /,
    *,
    task: TaskWords = None,
    output: Annotated[
        Path | None,
        Parameter(
            name=["--out", "-o"],
            help="File for the page (.html); by default report.html in the folder of the run, or next to the trace; "
            "with "
            "`--demo`, demo.html in the current folder.",
        ),
    ] = None,
    overwrite: Overwrite = False,
    demo: Annotated[bool, Parameter(negative="", help="Use the recorded run included with handeye.")] = False,
) -> int:
    """Write one self-contained HTML page of a run, or of two: 3D replay, pictures, forces, and what happened and why.

    Exit code 0: written, whatever the result of the run; 2: bad input.
    """
    from handeye.core import resources
    from handeye.runs.folder import REPORT

    made_known(task)
    replaced = ""
    if demo and run is not None:
        raise BadArgument("--demo has its own run; give either a run or --demo")
    if demo:
        place = output or Path(DEMO)
        replaced = "; the earlier file is replaced" if place.exists() else ""
        write_report(resources.demo(), place, overwrite=overwrite or output is None)
        note(f"open {place} in a browser")
    elif run is not None and other is not None:
        if output is None:
            raise BadArgument("a page of two runs has no default place; choose a file with -o")
        place = output
        write_comparison(run, other, place, overwrite=overwrite)
    else:
        run = run_or_newest(run)
        place = output or (run / REPORT if run.is_dir() else run.with_name(REPORT))
        replaced = "; the earlier file is replaced" if place.exists() else ""
        write_report(run, place, overwrite=overwrite or output is None)
    say(f"{place}{replaced}")
    return 0


def write_report(run: Path, place: Path, *, overwrite: bool) -> None:
    """Write the report of a run, given by its folder or trace; raises InvalidInput if it cannot be made or written."""
    from handeye.core.files import check_place, write_over
    from handeye.report.page.document import REPORT

    check_place(place, REPORT, overwrite=overwrite)
    write_over(place, page_of(run), REPORT)


def page_of(run: Path) -> bytes:
    """The page of the run in a folder or a trace. Raises InvalidInput if the folder or file contains no run."""
    from handeye.core.entries import entry_named
    from handeye.report.animation import animation
    from handeye.report.page.document import account_page, report_page
    from handeye.report.photographs import album
    from handeye.report.recorded import check_scene
    from handeye.runs.systems import system_named, system_of_files

    own = system_of_files(run)
    if own is not None and (page := own.page(run)) is not None:
        return page
    recorded = read_recorded(run)
    if "plans" not in entry_named(recorded.trace.head.system).can:
        return account_page(recorded, system_named(recorded.trace.head.system).parts(run))
    check_scene(recorded)
    return report_page(recorded, album(recorded), animation(recorded))


def read_recorded(run: Path) -> "RecordedRun":
    """Read the run in a folder or a trace, as far as it is readable. Raises InvalidInput if there is no run."""
    from handeye.results.recorded_run import recorded_run
    from handeye.trace.reading import is_cut_short, read_trace

    file = motion_file(run)
    cut = is_cut_short(file)
    return recorded_run(run, read_trace(file, lenient=cut), whole=not cut)


def compare(
    a: Annotated[
        Path | None,
        Parameter(
            name="A",
            help="The folder of a run, or its trace.mcap; by default the second newest run in the folder `runs`.",
        ),
    ] = None,
    b: Annotated[
        Path | None,
        Parameter(
            name="B",
            help=(
                "The run to compare with A, given in the same way; by default the newest run in the folder `runs`."
            ),
        ),
    ] = None,
    /,
    *,
    task: TaskWords = None,
    output: Annotated[
        Path | None,
        Parameter(
            name=["--out", "-o"],
            help="Also write a page (.html) that replays both runs with one time slider.",
        ),
    ] = None,
    overwrite: Overwrite = False,
    json: Json = False,
) -> int:
    """Compare two runs, step by step: show the first difference, and how the searches, stops and corrections of the
    runs differ.

    Runs of different plans, scenes or worlds are compared as far as possible. Exit code 0: compared, whatever the
    difference; 2: bad input.
    """
    from handeye.comparison.comparison import as_json, comparison
    from handeye.comparison.text import comparison_text

    made_known(task)
    one, other = two_runs(a, b)
    if output is None:
        found = comparison(read_recorded(one), read_recorded(other))
    else:
        found = write_comparison(one, other, output, overwrite=overwrite)
        note(f"page: {output}")
    return answer(as_json(found), comparison_text(found), json=json)


def write_comparison(a: Path, b: Path, place: Path, *, overwrite: bool) -> "Comparison":
    """Write the page for two runs, given by their folders or traces; raises InvalidInput if it cannot be written."""
    from handeye.comparison.comparison import comparison
    from handeye.comparison.page import PAGE, comparison_page
    from handeye.core.files import check_place, write_over

    check_place(place, PAGE, overwrite=overwrite)
    one, other = read_recorded(a), read_recorded(b)
    found = comparison(one, other)
    write_over(place, comparison_page(one, other, found, _animations(one, other)), PAGE)
    return found


def _animations(a: "RecordedRun", b: "RecordedRun") -> "Animations | str":
    """The animations of both runs, or the reason why there are none."""
    from handeye.report.animation import animation
    from handeye.report.recorded import check_scene

    made = []
    for run in (a, b):
        try:
            check_scene(run)
            shown = animation(run)
        except InvalidInput as fault:
            return f"{fault}."
        if shown is None:
            return f"{run.trace.name} contains no motion."
        made.append(shown)
    one, other = made
    return one, other


def show(run: Run = None, /, *, json: Json = False) -> int:
    """Show the result of a run, or its progress so far, without changing the run folder.

    Exit code 0: shown, whatever the result of the run; 2: there is no run to show.
    """
    folder = run_or_newest(run)
    kept = shown(folder, json=json)
    if not (kept.left and kept.result.completed):
        note(_way_on(folder, kept.result))
    return 0


def _way_on(folder: Path, result: "Result") -> str:
    """Return a sentence that says how to resume a run: with a command, or from Python if the run used Python code of
    the calling program.
    """
    from handeye.runs.parts import deciding, given_as
    from handeye.tasks import known_any, option

    parts = deciding(result.replaced or {})
    own = [f"{part} {quoted(name)}" for part, name in parts.items()]
    if known_any(result.task) is None:
        own.append(f"task {quoted(result.task)}")
    if not own:
        return f"resume with: handeye resume {shlex.join([str(folder), *option(result.task)])}"
    call = ", ".join([repr(str(folder)), *map(given_as, parts)])
    return (
        f"the run uses code of the calling program ({' and '.join(own)}); resume the run from Python with "
        f"handeye.begin({call})"
    )


def shown(folder: Path, *, json: bool, details: bool = True) -> "KeptRun":
    """Print the result or the progress of the run in a folder. Raises InvalidInput if the folder has neither."""
    from handeye.results.kept_run import kept_run
    from handeye.results.page import page, short_page
    from handeye.results.result import to_json

    kept = kept_run(folder)
    for fault in kept.faults:
        note(f"left out: {fault}")
    if json:
        sys.stdout.buffer.write(to_json(kept.result))
        sys.stdout.flush()
    else:
        screen.print(page(kept.result) if details else short_page(kept.result))
    return kept
