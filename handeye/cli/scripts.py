"""Commands on scripts and plans; nothing moves."""

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import msgspec
from cyclopts import App, Parameter

from handeye.al import compile_text, extensions
from handeye.cli.common import compiled, complain, say, screen, show, taught
from handeye.diagnostics import arranged, has_errors
from handeye.errors import InvalidInput
from handeye.plan.store import read_plan, write_plan
from handeye.source import read_source


def register(app: App) -> None:
    """Add the commands to the command line."""
    for command in (check, plan, stages):
        app.command(command)


def check(
    file: Path,
    *,
    json: Annotated[bool, Parameter(help="Diagnostics as JSON.")] = False,
    strict: Annotated[
        bool, Parameter(name="--strict-1973", negative="", help="Refuse words and operands that are ours.")
    ] = False,
    watch: Annotated[
        bool, Parameter(help="Check again whenever the script or what is taught changes.")
    ] = False,
) -> int:
    """Check a script and its taught positions, the arm's reach included; nothing moves."""
    if not watch:
        return _check(file, json=json, strict=strict)
    return watched(file, lambda: _check(file, json=json, strict=strict))


def _wait() -> None:
    time.sleep(0.25)


def watched(file: Path, check: Callable[[], int], pause: Callable[[], None] = _wait) -> int:
    """Check a script now and whenever it or the file of its taught positions changes, until Ctrl-C.

    Returns:
        the code of the last check; 2 if a file could not be used.
    """
    code, seen = 2, None
    try:
        while True:
            found = [_version(path) for path in (file, file.with_suffix(".toml"))]
            if found != seen:
                seen = found
                try:
                    code = check()
                except InvalidInput as error:
                    complain(error)
                    code = 2
            pause()
    except KeyboardInterrupt:
        return code


def _version(path: Path) -> tuple[int, int, int] | None:
    """What changes when a file does; editors often put another file in its place."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino


def _check(file: Path, *, json: bool, strict: bool) -> int:
    from handeye.arm.stanford import STANFORD
    from handeye.plan.planner import make_plan

    source = read_source(file)
    program, diagnostics = compile_text(source, taught(file))
    if program is not None:
        diagnostics = [*diagnostics, *make_plan(program, STANFORD)[1]]
    if strict:
        diagnostics = arranged([*diagnostics, *extensions(source.text)])
    show(diagnostics, source, json=json)
    if has_errors(diagnostics):
        return 2
    if not json:
        screen.print(f"{file}: no errors", markup=False)
    return 0


def plan(file: Path, *, output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None) -> int:
    """Compile a script into a plan.

    Parameters
    ----------
    output
        Where the plan goes; by default beside the script, with the ending .plan.json.
    """
    target = output or file.with_suffix(".plan.json")
    made = compiled(file)
    write_plan(target, made)
    counts = {"step": made.program.steps, "motion": made.motions, "stage": made.program.stages}
    said = ", ".join(f"{len(items)} {name}{'' if len(items) == 1 else 's'}" for name, items in counts.items())
    screen.print(f"{target}: {said}", markup=False)
    return 0


def stages(
    file: Path, *, json: Annotated[bool, Parameter(help="One JSON object on standard output.")] = False
) -> int:
    """List the stages of a plan and their steps, with lines of the source."""
    from handeye.stepping.listing import listing, listing_text

    made = read_plan(file)
    if json:
        sys.stdout.buffer.write(msgspec.json.format(msgspec.json.encode(listing(made)), indent=1) + b"\n")
        sys.stdout.flush()
    else:
        for line in listing_text(made):
            say(line)
    return 0
