"""Command on the records that runs leave."""

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, note, screen
from handeye.cli.trace_files import check_no_batch
from handeye.core.diagnostics import quoted

if TYPE_CHECKING:
    from handeye.results.kept_run import KeptRun
    from handeye.results.result import Result

Folder = Annotated[Path, Parameter(help="The folder of a run.")]


def show(folder: Folder, /, *, json: Json = False) -> int:
    """Show what a run came to, or how far it has come; its folder stays as it is.

    Exit code 0: it is shown, whatever the run came to; 2: there is no run that could be shown.
    """
    kept = shown(folder, json=json)
    if not (kept.left and kept.result.completed):
        note(_way_on(folder, kept.result))
    return 0


def _way_on(folder: Path, result: "Result") -> str:
    """Tell how a run is gone on with: from Python, if code of its caller belongs to it."""
    from handeye.runs.parts import deciding
    from handeye.tasks import known_any, option

    parts = deciding(result.replaced or {})
    own = [f"{part} {quoted(name)}" for part, name in parts.items()]
    if known_any(result.task) is None:
        own.append(f"task {quoted(result.task)}")
    if not own:
        return f"resume with: handeye resume {shlex.join([str(folder), *option(result.task)])}"
    call = ", ".join([repr(str(folder)), *(f"{part}=..." for part in parts)])
    return (
        f"the run has a {' and a '.join(own)} of its own: from Python, handeye.begin({call}) goes on with it"
    )


def shown(folder: Path, *, json: bool) -> "KeptRun":
    """Print what is known of the run in a folder; raises InvalidInput if there is no run that could be shown."""
    from handeye.results.kept_run import kept_run
    from handeye.results.page import page
    from handeye.results.result import to_json

    check_no_batch(folder)
    kept = kept_run(folder)
    for fault in kept.faults:
        note(f"left out: {fault}")
    if json:
        sys.stdout.buffer.write(to_json(kept.result))
        sys.stdout.flush()
    else:
        screen.print(page(kept.result))
    return kept
