"""Scripts of the task that is meant where none is named: their language, what is taught for them, their plan."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from handeye.al import AL, sewn
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.files import beside
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.program.language import Language, language_of
from handeye.program.taught import Taught, load_taught
from handeye.tasks import task
from handeye.tasks.interface import Task

if TYPE_CHECKING:
    from handeye.planning.scripts import PlannedScript

LANGUAGES: Final = {".al": AL}
"""Languages of scripts by the endings of their files; a file with another ending is taken for the first."""

UNNAMED: Final = "script.al"
"""Name of a text that comes from no file."""


def default_script(work: Task | None = None) -> Path:
    """The script of a task, by default of the one that is meant where none is named.

    Raises:
        InvalidInput: it comes with none.
    """
    work = work or task()
    if work.script is None:
        raise BadArgument(f"the task {quoted(work.name)} comes with no script; name one")
    return plans() / work.script


def taught(file: Path) -> Taught:
    """Positions and parts taught for a script, from the file beside it; a script may do without.

    Raises:
        InvalidInput: that file cannot be used.
    """
    return in_cell(taught_beside(file), task())


def taught_beside(file: Path) -> Taught:
    """What the file beside a script teaches, if there is one. Raises InvalidInput if it cannot be used."""
    path = beside(file, ".toml")
    return load_taught(path) if path.exists() else Taught()


def in_cell(known: Taught, work: Task) -> Taught:
    """What is taught, and the fixtures of the cell of a task where it says nothing of them."""
    return replace(known, fixtures={**work.fixtures(), **known.fixtures})


def plan_script(file: Path, known: Taught | None = None, work: Task | None = None) -> "PlannedScript":
    """Compile and plan the script in a file.

    Args:
        known: what is taught for it; by default by the file beside it.
        work: task whose arm is to do it; by default the one that is meant where none is named.

    Raises:
        InvalidInput: the script, or what is taught for it, cannot be read.
    """
    language = language_of(file, LANGUAGES)
    source = language.read(file)
    return planned(source, taught_beside(file) if known is None else known, work or task(), language)


def plan_text(text: str, known: Taught, work: Task) -> "PlannedScript":
    """Compile and plan a text; the files that it requires are looked for where this program runs."""
    source = sewn(Source(name=UNNAMED, text=text.removeprefix("\ufeff")), lambda key: read_source(key).text)
    return planned(source, known, work, AL)


def planned(source: Source, known: Taught, work: Task, language: Language) -> "PlannedScript":
    """The plan of a source for the arm of a task."""
    from handeye.planning.scripts import plan_source  # not before something is planned: it takes a while

    return plan_source(source, in_cell(known, work), work.arm, language)
