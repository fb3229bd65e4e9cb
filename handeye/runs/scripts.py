"""Scripts of the task that is meant where none is named: their language, what is taught for them, their plan."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from handeye.al import AL
from handeye.files import beside
from handeye.program.language import language_of
from handeye.program.taught import Taught, load_taught
from handeye.resources import plans
from handeye.tasks import task

if TYPE_CHECKING:
    from handeye.planning.scripts import PlannedScript

LANGUAGES: Final = {".al": AL}
"""Languages of scripts by the endings of their files; a file with another ending is taken for the first."""


def default_script() -> Path:
    """The script of the task that is meant where none is named."""
    script = task().script
    assert script is not None
    return plans() / script


def taught(file: Path) -> Taught:
    """Positions and parts taught for a script, from the file beside it; a script may do without.

    Raises:
        InvalidInput: that file cannot be used.
    """
    path = beside(file, ".toml")
    known = load_taught(path) if path.exists() else Taught()
    return replace(known, fixtures={**task().fixtures(), **known.fixtures})


def plan_script(file: Path) -> "PlannedScript":
    """Compile and plan the script in a file, for the arm of the task.

    Raises:
        InvalidInput: the script, or what is taught for it, cannot be read.
    """
    from handeye.planning.scripts import plan_source  # not before something is planned: it takes a while

    language = language_of(file, LANGUAGES)
    return plan_source(language.read(file), taught(file), task().arm, language)
