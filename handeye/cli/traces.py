"""Commands that read the traces of runs."""

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import (
    Json,
    Overwrite,
    PictureFile,
    SceneCamera,
    Size,
    TaskWords,
    note,
    notes,
    put,
    put_json,
    say,
    screen,
    width_and_height,
)
from handeye.cli.programs import check_task, made_known
from handeye.cli.trace_files import RunOrEvents, RunOrTrace, run_or_newest, trace_file
from handeye.cli.worlds import PLAIN, FineOptions
from handeye.core.errors import Refused
from handeye.core.files import check_place, write_over
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    from handeye.program.events import AnyEvent
    from handeye.trace.reading import Trace


def show(
    run: RunOrEvents = None,
    /,
    *,
    json: Annotated[bool, Parameter(help="Print the events as JSON lines.")] = False,
) -> int:
    """Show what happened in a run, and why."""
    from handeye.program.events import to_line
    from handeye.trace.account import account

    _, events = _read(run_or_newest(run))
    if json:
        put(b"".join(map(to_line, events)))
        return 0
    for line in account(events):
        say(line)
    return 0


def stats(run: RunOrEvents = None, /, *, json: Json = False) -> int:
    """For each stage of a run, count what happened, and show how long the stage took."""
    from handeye.trace.stats import statistics, statistics_table

    trace, events = _read(run_or_newest(run))
    figures = statistics(events, {} if trace is None else trace.counts)
    if json:
        put_json(figures)
    else:
        screen.print(statistics_table(figures, screen.width))
    return 0


def photograph(
    run: RunOrTrace = None,
    /,
    *,
    at: Annotated[float, Parameter(help="Seconds since the run began, as `show` prints them.")],
    output: PictureFile,
    task: TaskWords = None,
    camera: SceneCamera = None,
    overwrite: Overwrite = False,
    size: Size = "1280x960",
    how: FineOptions = PLAIN,
) -> int:
    """Photograph the cell at a moment of a recorded run, without simulating it again."""
    from handeye.cell.photograph import PNG, png
    from handeye.cell.posed import posed

    wanted = made_known(task)
    width, height = width_and_height(size)
    check_place(output, PNG, overwrite=overwrite)
    file = run_or_newest(run)
    trace, _ = _read(file)
    if trace is None:
        raise Refused(f"{file} is an event list, which holds no positions; use the trace.mcap")
    check_task(wanted, trace.head.task, file)
    state = trace.at(at)
    shot = how.take(posed(trace.scene, state.poses, state.time), camera or trace.overview, width, height)
    write_over(output, png(shot), PNG)
    doing = "" if state.step is None else f", line {state.step.place}: {state.step.text}"
    say(f"{output}: {state.time:.2f} s{doing}")
    return 0


def verify(run: RunOrTrace = None, /, *, task: TaskWords = None) -> int:
    """Repeat a recorded run, and compare the repetition with the recording.

    The actions of operators and experimenters are repeated as well. An interrupted run is compared up to its last
    complete step. The command reports one of three results: the run repeats exactly; it repeats except for rounding in
    the last digits, which depends on the kind of processor and on the versions; or it differs, and the report says
    where.

    Exit code 0: the run repeats, exactly or except for rounding; 1: it differs; 2: bad input.
    """
    from handeye.core.processor import processor
    from handeye.core.versions import versions
    from handeye.runs.verify import repetition, settled

    wanted, file = made_known(task), run_or_newest(run)
    trace, events = _read(file)
    if trace is None:
        raise Refused(f"{file} is an event list; verify the trace.mcap next to it, which also holds the plan")
    check_task(wanted, trace.head.task, file)
    changed = [name for name, version in versions().items() if trace.head.versions.get(name) != version]
    if changed:
        sentence = (
            f"the run was recorded with other versions of {', '.join(changed)}, so it may not repeat exactly"
        )
        note(sentence)
    recorded = trace.head.processor or ""
    elsewhere = ", on another kind of processor" if recorded and recorded != processor() else ""
    if elsewhere:
        note(f"the run was recorded on {recorded}; this processor is {processor()}")
    with tempfile.TemporaryDirectory(prefix="handeye-") as folder, notes.status("repeating the run"):
        found = repetition(trace, Path(folder) / "run")
    if found.parts is not None:
        say(f"{file} does not repeat{elsewhere}: {found.parts}")
        if found.rounded is not None:
            say(
                "before this difference, numbers differ only by rounding, which depends on the kind of processor; "
                f"the first difference by rounding: {found.rounded}"
            )
        return 1
    count = settled(events)
    ended = "" if count == len(events) else " up to the step that was interrupted"
    same = f"the same {counted(count, 'event')}{ended}"
    if found.rounded is None:
        say(f"{file} repeats exactly: {same}, byte for byte")
    else:
        why = elsewhere or (", with other versions" if changed else ", as on another kind of processor")
        say(f"{file} repeats except for rounding{why}: {same}; the first difference: {found.rounded}")
    if trace.begins > 0:
        note(f"motions before {trace.begins:.2f} s are not in this trace and were not compared")
    return 0


def _read(file: Path) -> tuple["Trace | None", list["AnyEvent"]]:
    """The trace in a file or folder, and those of its events that were not undone."""
    from handeye.trace.eventlist import effective, read_events
    from handeye.trace.reading import read_trace

    file = trace_file(file)
    if file.suffix == ".jsonl":
        return None, effective(read_events(file))
    trace = read_trace(file, lenient=file.suffix == ".part")
    return trace, list(trace.events)
