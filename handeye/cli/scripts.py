"""Commands for scripts and plans: check, compile, list, inspect; nothing is executed."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import msgspec
from cyclopts import Parameter

from handeye.al import extensions
from handeye.cli.common import (
    Json,
    Overwrite,
    PlanFile,
    Script,
    TaskWords,
    answer,
    complain,
    note,
    put_json,
    say,
    show,
    show_unreadable,
)
from handeye.cli.drawings import write_drawing, write_text
from handeye.cli.programs import compiled, plan_at, script_at
from handeye.cli.proofs import PROOF, ProofOptions, proved, refuse_with_prove
from handeye.core.diagnostics import arranged, has_errors
from handeye.core.errors import BadArgument, InvalidInput
from handeye.core.files import beside, check_place, read_whole
from handeye.core.plain_text import counted
from handeye.core.source import read_source
from handeye.planfile.store import PLAN, write_plan
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
    json: Annotated[bool, Parameter(help="Print diagnostics as JSON.")] = False,
    strict: Annotated[
        bool,
        Parameter(
            name="--strict-1973", help="Refuse words and operands that handeye adds to the 1973 language."
        ),
    ] = False,
    watch: Annotated[
        bool, Parameter(help="Check again whenever the script, a required file or the taught file changes.")
    ] = False,
    prove: Annotated[
        bool,
        Parameter(
            group=PROOF,
            help="Also prove that, on every path to the end of the program, the program would notice if a finding "
            "of the task's referee did not hold. With --prove, FILE may also be a plan.",
        ),
    ] = False,
    proof: ProofOptions | None = None,
) -> int:
    """Check a script and its taught positions, and whether the arm reaches its goals; nothing moves.

    Exit code 0: no errors; 2: errors, or bad input. With --watch, Ctrl-C ends the command with the exit code of the
    last check.
    """
    options = proof or ProofOptions()
    if prove:
        refuse_with_prove(strict=strict, watch=watch)
        return proved(file, task, options, json=json)
    options.refuse_without_prove()
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
    """Check a script now and whenever one of its files changes, until Ctrl-C. Return the code of the last check."""
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
    """The files that a check of a script reads."""
    if own_language(file.name) is not None:
        return [file]
    try:
        required = [Path(text.name) for text in language_of(file, LANGUAGES).read(file).required]
    except InvalidInput:
        required = []
    return [file, beside(file, ".toml"), *required]


def _version(path: Path) -> Version:
    """A value that identifies the version of a file: the value changes when the file is edited or replaced."""
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
    output: Annotated[Path | None, Parameter(name=["--out", "-o"])] = None,
    overwrite: Overwrite = False,
) -> int:
    """Compile a script into a plan.

    Parameters
    ----------
    output
        File for the plan. The default is a file with the ending .plan.json next to the script; for a program of
        handeye, in the current folder. An earlier plan at the default place is replaced; to replace another file,
        give --overwrite.
    """
    script, work = script_at(file, task)
    target = output or beside(file, ".plan.json")
    made = compiled(script, work)
    check_place(target, PLAN, overwrite=overwrite or output is None)
    before = read_whole(target) if target.is_file() else b""
    write_plan(target, made)
    replaced = ", replacing an earlier plan" if before not in (b"", read_whole(target)) else ""
    counts = {"step": made.program.steps, "motion": made.motions, "stage": made.program.stages}
    said = ", ".join(counted(len(items), name) for name, items in counts.items())
    say(f"{target}: {said}{replaced}")
    return 0


def stages(
    file: PlanFile, /, *, json: Annotated[bool, Parameter(help="Print one JSON object.")] = False
) -> int:
    """List the stages of a plan and their steps, with their source lines."""
    from handeye.debugger.listing import listing, listing_text

    made = plan_at(file)
    return answer(listing(made.program), listing_text(made.program), json=json)


StageName = Annotated[
    str | None, Parameter(help="Only this stage, given by its number, its name, or part of its name.")
]


def inspect(
    file: PlanFile,
    /,
    *,
    stage: StageName = None,
    graph: Annotated[Literal["svg", "dot"] | None, Parameter(help="Draw the flow chart instead.")] = None,
    output: Annotated[
        Path | None,
        Parameter(name=["--out", "-o"], help="File for the drawing. Default: standard output."),
    ] = None,
    overwrite: Overwrite = False,
    json: Json = False,
) -> int:
    """Show what a plan does: stages, steps, times, guards, forces, and what each step depends on."""
    from handeye.debugger.breakpoints import stage_number
    from handeye.inspection.flow import flow
    from handeye.inspection.inspection import inspection, inspection_text

    if graph is not None and json:
        raise BadArgument("--graph and --json cannot be given together")
    plan = plan_at(file)
    number = None if stage is None else stage_number(stage, plan.program) + 1
    if graph is not None:
        shown = flow(plan, number)
        write_drawing(shown, graph, output, overwrite=overwrite)
    elif output is not None:
        raise BadArgument("--out needs --graph svg or --graph dot")
    elif json:
        found = inspection(plan)
        kept = tuple(s for s in found.stages if number in (None, s.number))
        put_json(msgspec.structs.replace(found, stages=kept))
    else:
        for line in inspection_text(inspection(plan), number):
            say(line)
    return 0


def diff(old: PlanFile, new: PlanFile, /, *, json: Json = False) -> int:
    """Compare what two plans do, step by step.

    Exit code 0: both do the same; 1: they differ; 2: bad input.
    """
    from handeye.inspection.difference import difference
    from handeye.inspection.difference_text import difference_text

    found = difference(plan_at(old), plan_at(new))
    answer(found, difference_text(found), json=json)
    return 0 if found.same else 1


def schema(
    *,
    output: Annotated[
        Path | None,
        Parameter(name=["--out", "-o"], help="File for the schema. Default: standard output."),
    ] = None,
    overwrite: Overwrite = False,
) -> int:
    """Print the JSON schema of the plan format."""
    from handeye.planfile.schema import SCHEMA, plan_schema

    write_text(plan_schema(), output, SCHEMA, overwrite=overwrite)
    return 0
