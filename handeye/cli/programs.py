"""Finds the script or plan that an argument of a command names. The argument is a file, or the name of an included
program.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Final

from handeye.cli.common import note, show
from handeye.core.diagnostics import LIMIT, quoted, suggestion
from handeye.core.errors import BadArgument, BadFile, NoSuchName
from handeye.planfile.plan import Plan
from handeye.planfile.store import read_plan
from handeye.runs.scripts import LANGUAGES, default_script, plan_script, program_named, program_names, task_of
from handeye.tasks import known_any, named, planned, task

if TYPE_CHECKING:
    from handeye.tasks.interface import Task

_LEAVE_OUT: Final = "leave out --task, or give the right task"


def compiled(file: Path, work: "Task | None" = None) -> Plan:
    """The plan of a script for a task, by default the script's own task. Prints the diagnostics of the script. If the
    script has no plan, the command exits.
    """
    made = plan_script(file, work=work)
    show(made.diagnostics, made.source, json=False)
    if made.plan is not None:
        return made.plan
    errors = sum(d.severity == "error" for d in made.diagnostics)
    count = "1 error" if errors == 1 else f"{errors}{' or more' if errors == LIMIT else ''} errors"
    raise BadFile(f"{file} has {count}; no plan was made")


def script_at(given: Path, task_words: str | None) -> "tuple[Path, Task]":
    """Return a script and its task. The script is the file or, if there is no such file, the program with that name.
    Raises InvalidInput if there is neither.
    """
    wanted = None if task_words is None else planned(named(task_words))
    program = None if given.is_file() else _program(given)
    if program is None:
        _note_file(given)
        return given, wanted or task_of(given)
    file, work = program
    if wanted not in (None, work):
        raise BadArgument(
            f"the program {quoted(given.name)} belongs to the task {quoted(work.name)}, not to "
            f"{quoted(wanted.name)}; {_LEAVE_OUT}"
        )
    note(f"{given}: using the program of the task {work.name}, {file}")
    return program


def plan_at(given: Path, task_words: str | None = None) -> Plan:
    """The plan of a file or of a program. If `given` is a file, the file contains either a plan or a script; a script
    is compiled. If there is no such file, `given` is the name of a program.

    Raises:
        InvalidInput: there is no such plan for the task.
    """
    wanted = None if task_words is None else planned(named(task_words))
    if is_program(given) or (given.suffix.lower() in LANGUAGES and given.is_file()):
        return compiled(*script_at(given, task_words))
    plan = read_plan(given)
    if wanted is not None and wanted.name != plan.task:
        raise BadArgument(
            f"{given} is a plan for the task {quoted(plan.task)}, not for {quoted(wanted.name)}; {_LEAVE_OUT}"
        )
    _note_file(given)
    return plan


def plan_or_own(given: Path | None, task_words: str | None) -> Plan:
    """The plan that `plan_at` finds; by default the plan of the task's own program."""
    if given is not None:
        return plan_at(given, task_words)
    work = task() if task_words is None else planned(named(task_words))
    return compiled(default_script(work), work)


def is_program(given: Path) -> bool:
    """Return True if `given` is the name of a program, and False if it is the path of a file. Raises NoSuchName if no
    program and no file has this name.
    """
    return not given.is_file() and _program(given) is not None


def _program(given: Path) -> "tuple[Path, Task] | None":
    """Return the program that has the name `given`, or None if `given` is a path. Raises NoSuchName if there is
    neither a program nor a file of this name.
    """
    if not _is_name(given):
        return None
    found = program_named(given.name)
    if found is None and not given.exists():
        if (other := known_any(given.name)) is not None:
            planned(other)  # raises an error that says why this task has no plan
        near = suggestion(given.name, program_names()) or "give a file"
        raise NoSuchName(f"{given}: there is no such file, and no program of that name; {near}")
    return found


def _note_file(given: Path) -> None:
    """If there is also a program with the name of the file, print a note that the file is used instead of this
    program.
    """
    if _is_name(given) and given.is_file() and program_named(given.name) is not None:
        note(f"{given}: using this file, not the program of the same name")


def _is_name(given: Path) -> bool:
    return len(given.parts) == 1 and not given.suffix


def made_known(words: str | None) -> str | None:
    """The name of the task that `--task` gives; None if the option was left out. This call registers the task."""
    return None if words is None else named(words).name


def check_task(wanted: str | None, found: str, of: Path) -> None:
    """Raises BadArgument if `--task` names a task different from that of the run."""
    if wanted not in (None, found):
        raise BadArgument(
            f"the run in {of} belongs to the task {quoted(found)}, not to {quoted(wanted)}; leave out --task"
        )
