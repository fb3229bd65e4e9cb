"""Commands on scripts and plans; nothing moves."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.al import extensions
from handeye.cli.common import (
    PlanFile,
    Script,
    TaskWords,
    complain,
    note,
    put_json,
    say,
    show,
    show_unreadable,
)
from handeye.cli.programs import compiled, plan_at, script_at
from handeye.core.diagnostics import arranged, has_errors
from handeye.core.errors import InvalidInput
from handeye.core.files import beside
from handeye.core.plain_text import counted
from handeye.core.source import read_source
from handeye.planfile.store import write_plan
from handeye.program.language import language_of, own_language
from handeye.runs.scripts import LANGUAGES, planned, taught_beside

if TYPE_CHECKING:
    from handeye.tasks.interface import Task

Version = tuple[int, int, int] | None


def check(
    file: Script,
    /,
    *,
    task: TaskWords = None,
    json: Annotated[bool, Parameter(help="Diagnostics as JSON.")] = False,
    strict: Annotated[
        bool,
        Parameter(
            name="--strict-1973", help="Refuse words and operands that handeye adds to the language of 1973."
        ),
    ] = False,
    watch: Annotated[
        bool, Parameter(help="Check again whenever the script, a required file or the taught file changes.")
    ] = False,
) -> int:
    """Check a script and its taught positions, the arm's reach included; nothing moves.

    Exit code 0: no errors; 2: errors, or bad input. Ctrl-C ends watching, with the code of the last check.
    """
    file, work = script_at(file, task)

    def once() -> int:
        try:
            return _check(file, work, json=json, strict=strict)
        except InvalidInput as error:
            if not json:
                raise
            show_unreadable(file, error)
            return 2

    return watched(file, once) if watch else once()


def _wait() -> None:
    time.sleep(0.25)


def watched(file: Path, check: Callable[[], int], pause: Callable[[], None] = _wait) -> int:
    """Check a script now and whenever a file it looks at changes, until Ctrl-C; returns the code of the last check."""
    code = 2
    seen: dict[Path, Version] = {}
    note(f"watching {file}; Ctrl-C ends it")
    try:
        while True:
            changed = [str(path) for path in seen if seen[path] != _version(path)]
            if changed or not seen:
                if changed:
                    note(f"\n── {', '.join(changed)} changed")
                seen = {path: _version(path) for path in _files(file)}
                try:
                    code = check()
                except InvalidInput as error:
                    complain(error)
                    code = 2
            pause()
    except KeyboardInterrupt:
        return code


def _files(file: Path) -> list[Path]:
    """The files that a check of a script looks at."""
    if own_language(file.name) is not None:
        return [file]
    try:
        required = [Path(text.name) for text in language_of(file, LANGUAGES).read(file).required]
    except InvalidInput:
        required = []
    return [file, beside(file, ".toml"), *required]


def _version(path: Path) -> Version:
    """Version of a file: changes with it, and when an editor puts another file in its place."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino


def _check(file: Path, work: "Task", *, json: bool, strict: bool) -> int:
    own = own_language(file.name)
    if own is not None:
        source = read_source(file)
        diagnostics = own.check(source)
    else:
        language = language_of(file, LANGUAGES)
        source = language.read(file)
        diagnostics = planned(source, taught_beside(file), work, language).diagnostics
    if strict and own is None:
        diagnostics = arranged([*diagnostics, *extensions(source)])
    show(diagnostics, source, json=json)
    if has_errors(diagnostics):
        return 2
    if not json:
        say(f"{file}: no errors")
    return 0


def plan(
    file: Script,
    /,
    *,
    task: TaskWords = None,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
) -> int:
    """Compile a script into a plan.

    Parameters
    ----------
    output
        File for the plan; by default beside the script, with the ending .plan.json; of a program by its name, in this
        folder.
    """
    script, work = script_at(file, task)
    target = output or beside(file, ".plan.json")
    made = compiled(script, work)
    write_plan(target, made)
    counts = {"step": made.program.steps, "motion": made.motions, "stage": made.program.stages}
    said = ", ".join(counted(len(items), name) for name, items in counts.items())
    say(f"{target}: {said}")
    return 0


def stages(
    file: PlanFile, /, *, json: Annotated[bool, Parameter(help="One JSON object on standard output.")] = False
) -> int:
    """List the stages of a plan and their steps, with lines of the source."""
    from handeye.debugger.listing import listing, listing_text

    made = plan_at(file)
    if json:
        put_json(listing(made.program))
    else:
        for line in listing_text(made.program):
            say(line)
    return 0
