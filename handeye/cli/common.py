"""Parts that the commands share: consoles, options, scripts and their diagnostics."""

import os
import re
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated, Final, Literal

import msgspec
from cyclopts import Parameter, Token
from rich.console import Console

from handeye.core.diagnostics import LIMIT, Diagnostic, as_json, quoted, visible
from handeye.core.diagnostics import render as render_diagnostic
from handeye.core.errors import BadArgument, InvalidInput
from handeye.core.plain_text import counted, folded
from handeye.core.source import Source

MOST: Final = 1_000_000
LONGEST_NUMBER: Final = 99  # characters
_USUAL_WIDTH: Final = 80

Script = Annotated[
    Path,
    Parameter(
        help="A script (.al), with its taught positions (.toml) next to it; or the name of a program of a task, "
        "such as `insertion`."
    ),
]
PlanFile = Annotated[
    Path,
    Parameter(
        help="A plan made by `handeye plan` (.plan.json), a script (.al), or the name of a program of a task, "
        "such as `insertion`."
    ),
]
TaskWords = Annotated[
    str | None,
    Parameter(
        name="--task",
        help="The task: its name, or MODULE:NAME for a task of your own, in a module on Python's path or in the "
        "current folder. Default: the task that the plan, program or run names; if it names none, the water pump.",
    ),
]
CameraKind = Literal["auto", "gl", "ray"]


def camera_here(kind: CameraKind) -> Literal["gl", "ray"]:
    """The renderer that `auto` means on this computer; a batch records which renderer made its pictures."""
    from handeye.cell.camera import renderer_here

    return kind if kind != "auto" else renderer_here(kind)


def whole(_: type, tokens: Sequence[Token]) -> int:
    """Convert typed text to a whole number. Raises ValueError if the text is not a whole number (1.5, for example), or
    if the number is too large.
    """
    typed = tokens[0].value
    if not re.fullmatch(r"[+-]?[0-9]+", typed):
        raise ValueError(f"{quoted(typed)} is not a whole number")
    if len(typed) > LONGEST_NUMBER:
        raise ValueError(f"{quoted(typed)} is too large a number")
    return int(typed)


def width_and_height(size: str) -> tuple[int, int]:
    """Width and height of a picture; raises BadArgument unless they are written like 480x360."""
    found = re.fullmatch(r"([0-9]{1,9})x([0-9]{1,9})", size)
    if found is None:
        raise BadArgument(f"{quoted(size)} is not a size; write it like 480x360")
    return int(found[1]), int(found[2])


def positive(count: int, what: str) -> None:
    """Raises BadArgument unless a count is from 1 to MOST; `what` is the singular of the counted noun."""
    many = counted(0, what).removeprefix("0 ")
    if count < 1:
        raise BadArgument(f"the number of {many} must be at least 1, not {count}")
    if count > MOST:
        raise BadArgument(f"the number of {many} must be at most {MOST:,}, not {count}")


WholeNumber = Annotated[int, Parameter(converter=whole)]
PictureFile = Annotated[Path, Parameter(name=["--out", "-o"], help="File for the picture (.png).")]
Overwrite = Annotated[bool, Parameter(help="Replace existing files.")]
SceneCamera = Annotated[
    str | None,
    Parameter(
        help="A camera of the scene. Default: the camera that shows the whole cell, `studio` for the pump."
    ),
]
Size = Annotated[str, Parameter(help="Width and height in pixels.")]
Camera = Annotated[
    CameraKind,
    Parameter(
        help="How to render pictures: `gl` (OpenGL), `ray` (ray casting), or `auto` (OpenGL if it works here, "
        "or else ray casting)."
    ),
]
Calibrate = Annotated[
    bool,
    Parameter(help="Calibrate the camera again instead of using a kept calibration (see `handeye cache`)."),
]
Json = Annotated[
    bool, Parameter(help="Print one JSON object to standard output, everything else to standard error.")
]
Out = Annotated[
    Path | None,
    Parameter(
        name=["--out", "-o"],
        help="Folder in which to save plan, events, trace, checkpoints, pictures and result.",
    ),
]


Details = Annotated[
    bool, Parameter(help="Print all tables at the end: stages, times, and each finding of the referee.")
]
NoKeep = Annotated[
    bool,
    Parameter(
        name="--no-keep",
        help="Keep no record of the run. By default, the run is saved in a new folder in `runs`. The folder `runs` "
        "keeps only the newest ten runs.",
    ),
]
CALLED: Final = os.environ.get("HANDEYE_CALLED", "handeye")
"""The name by which the user called handeye. Sentences that suggest a command begin the command with this name.
`run.py` sets the environment variable.
"""


class _Screen(Console):
    def __init__(self, *, stderr: bool = False) -> None:
        super().__init__(stderr=stderr, highlight=False, emoji=False, markup=False)
        if not self.width:  # COLUMNS=0, from a shell that does not know the width
            self.width = _USUAL_WIDTH

    def on_broken_pipe(self) -> None:
        """Raise the error; the command line turns the error into an exit code."""
        raise BrokenPipeError


screen = _Screen()
notes = _Screen(stderr=True)


def say(text: str, to: Console = screen, *, style: str | None = None, whole: bool = False) -> None:
    """Print plain text, which may come from an untrusted file.

    On a terminal, lines are wrapped between words. If `whole` is true, the text is meant to be copied, so its lines
    are not wrapped.
    """
    shown = visible(text)
    if to.is_terminal and not whole:
        shown = folded(shown, to.width)
    to.print(shown, style=style, soft_wrap=True)


def put(answer: bytes) -> None:
    """Write an answer for another program, or the content of a file. The encoding is UTF-8, even if the terminal has a
    different encoding.
    """
    sys.stdout.buffer.write(answer)
    sys.stdout.flush()


def put_line(text: str) -> None:
    """Write one line of the JSON answers that another program reads."""
    put(f"{text}\n".encode())


def put_json(answer: object) -> None:
    """Write an answer as indented JSON."""
    put(msgspec.json.format(msgspec.json.encode(answer), indent=1) + b"\n")


def answer(found: object, lines: Iterable[str], *, json: bool) -> int:
    """Print the answer as JSON or as text, and return the answer's exit code."""
    if json:
        put_json(found)
    for line in () if json else lines:
        say(line)
    return 0


def note(text: str) -> None:
    """Print a note for the user, on standard error."""
    say(text, notes)


def complain(error: object) -> None:
    """Print the reason why a command failed."""
    say(f"handeye: {error}", notes, style="red")


def show(diagnostics: list[Diagnostic], source: Source, *, json: bool) -> None:
    """Print diagnostics: as JSON on standard output, or as text on standard error."""
    if json:
        put_json([as_json(d, source) for d in diagnostics])
        return
    if len(diagnostics) == LIMIT:
        note(f"showing the first {LIMIT} diagnostics")
    for diagnostic in diagnostics:
        notes.print(render_diagnostic(diagnostic, source), markup=False, soft_wrap=True, end="\n\n")


def show_unreadable(file: Path, error: InvalidInput) -> None:
    """Print the reason why the script or the taught file cannot be used, as JSON, in place of diagnostics."""
    place = {"file": str(file), "line": 1, "column": 1, "end": 1, "text": ""}
    said = {"code": "unreadable-file", "severity": "error", "message": str(error), "file": str(file)}
    put_json([{**said, "primary": place, "secondary": [], "notes": [], "help": None}])
