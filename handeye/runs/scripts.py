"""Finds the scripts of tasks, their languages and their taught positions, and plans the scripts."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final, get_args

from handeye import tasks
from handeye.al import AL, sewn
from handeye.core.diagnostics import quoted
from handeye.core.entries import entry_of_file, refusal
from handeye.core.errors import BadArgument
from handeye.core.files import beside, is_there
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.program.language import Language, language_of
from handeye.program.taught import Taught, load_taught
from handeye.tasks.interface import Task

if TYPE_CHECKING:
    from handeye.planning.planner import PlannedScript

LANGUAGES: Final = {".al": AL}
"""Languages of scripts by file ending. A file with any other ending is read in the first language of this table."""

UNNAMED: Final = "script.al"  # name of a text that comes from no file


def default_script(work: Task | None = None) -> Path:
    """Return the script of a task, or of the default task. Raises InvalidInput if the task has no script."""
    work = work or tasks.task()
    if work.script is None:
        raise BadArgument(f"the task {quoted(work.name)} has no script; give the path of a script")
    return plans() / work.script


def program_named(name: str) -> tuple[Path, Task] | None:
    """Return the script with the file name `name` (without extension) that is included with handeye, and the task of
    this script. Returns None if no included script has this name.
    """
    return next((each for each in _programs() if each[0].stem == name), None)


def program_names() -> list[str]:
    return [file.stem for file, _ in _programs()]


def task_of(file: Path) -> Task:
    """Return the task to which a script belongs, or the default task if the script belongs to no task."""
    whole = file.resolve()
    own = tasks.of_plans("ours") if whole.parent == plans().resolve() else tasks.of_plans("registered")
    return next((work for work in own if whole in _scripts(work)), None) or tasks.task()


def _programs() -> Iterator[tuple[Path, Task]]:
    """Yield the scripts of all tasks, each with its task."""
    for kind in get_args(tasks.Kind):
        for work in tasks.of_plans(kind):
            yield from ((script, work) for script in _scripts(work))


def _scripts(work: Task) -> list[Path]:
    return [(plans() / each).resolve() for each in (work.script, *work.other_scripts) if each]


def taught(file: Path, work: Task | None = None) -> Taught:
    """Return the positions and parts in the taught file beside a script, together with the fixtures of the script's
    task. Raises InvalidInput if the taught file cannot be used.
    """
    return in_cell(taught_beside(file), work or task_of(file))


def taught_beside(file: Path) -> Taught:
    """Return the positions in the taught file beside a script, or no positions if the script has no taught file."""
    path = beside(file, ".toml")
    return load_taught(path) if is_there(path) else Taught()


def in_cell(known: Taught, work: Task) -> Taught:
    """Add the fixtures of the task's cell to taught positions. If a taught fixture and a fixture of the cell have the
    same name, the taught one is used.
    """
    return replace(known, fixtures={**work.fixtures(), **known.fixtures})


def plan_script(file: Path, known: Taught | None = None, work: Task | None = None) -> "PlannedScript":
    """Compile and plan a script. By default, the function uses the script's own task, and the taught file in the
    script's folder. Raises InvalidInput if a file cannot be used.
    """
    entry, _ = entry_of_file(file.name)
    if entry is not None:
        raise refusal(entry.name, "plans", str(file))
    language = language_of(file, LANGUAGES)
    source = language.read(file)
    return planned(source, taught_beside(file) if known is None else known, work or task_of(file), language)


def plan_text(text: str, known: Taught, work: Task) -> "PlannedScript":
    """Compile and plan a text. The current folder is searched for the files that the text requires."""
    source = sewn(Source(name=UNNAMED, text=text.removeprefix("\ufeff")), lambda key: read_source(key).text)
    return planned(source, known, work, AL)


def planned(source: Source, known: Taught, work: Task, language: Language) -> "PlannedScript":
    """Plan a source for the arm of a task."""
    from handeye.planning.planner import plan_source  # imported only for planning, because this takes a while

    return plan_source(source, in_cell(known, work), work.arm, language, task=work.name)
