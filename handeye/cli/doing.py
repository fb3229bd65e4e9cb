"""Commands for programming by doing: functions carried out at once, and the two modes of the arm program."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from handeye.cli.common import Camera, Json, Seed, screen, world
from handeye.cli.panic import PanicButton
from handeye.cli.typing import typed_lines
from handeye.errors import InvalidInput
from handeye.plan.taught import Taught, load_taught
from handeye.resources import plans

if TYPE_CHECKING:
    from handeye.doing.answers import Answer
    from handeye.doing.workplace import Workplace

TaughtFile = Annotated[
    Path | None, Parameter(name="--taught", help="File of taught positions; by default the water pump's.")
]
Looking = Annotated[bool, Parameter(name="--look", negative="", help="Set the camera up first.")]
From = Annotated[Path | None, Parameter(name="--from", help="Begin with the cell as this checkpoint has it.")]
Keep = Annotated[Path | None, Parameter(help="Keep the cell as it is at the end in this checkpoint.")]


def register(app: App) -> None:
    """Add the commands to the command line."""
    for command in (do, repl):
        app.command(command)


def do(
    *functions: str,
    seed: Seed = 0,
    taught: TaughtFile = None,
    look: Looking = False,
    first: From = None,
    keep: Keep = None,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Plan functions and carry them out at once, each by itself: `handeye do "OPEN 3" PARK`.

    Exit code 0: done; 1: the operator was called; 2: bad input; 130: interrupted.

    Parameters
    ----------
    functions
        A function of the arm language each; modifiers stand before theirs, with a line end between.
    """
    from handeye.doing.answers import converse
    from handeye.doing.commands import Typist
    from handeye.doing.repl import Repl
    from handeye.stepping.checkpoint_file import write_checkpoint

    if not functions:
        raise InvalidInput('a function is wanted, such as `handeye do "OPEN 3"`')
    with PanicButton() as panic:
        workplace = _workplace(panic, taught, seed=seed, camera=camera, look=look, first=first)
        lines = (f"DO {function}" for function in functions)
        typist = Typist(Repl(workplace=workplace, folder=Path()))
        failed = converse(typist, lines, _say, json=json, strict=True)
    if keep is not None and (failed is None or not failed.refused):
        write_checkpoint(keep, workplace.checkpoint())
    return _code(failed)


def repl(
    script: Path | None = None,
    *,
    seed: Seed = 0,
    taught: TaughtFile = None,
    look: Looking = False,
    first: From = None,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Type functions: they are collected and checked; DO carries them out. HELP tells the rest.

    Exit code 0: left; 1: the operator was called at last; 2: a line was refused, and came from no terminal;
    130: interrupted.

    Parameters
    ----------
    script
        A script beside which programs for `DO NAME`, and what is taught, are looked for.
    """
    from handeye.al.instructions import INSTRUCTIONS
    from handeye.doing.answers import converse
    from handeye.doing.commands import COMMANDS, Typist
    from handeye.doing.repl import Repl

    if script is not None and taught is None and script.with_suffix(".toml").exists():
        taught = script.with_suffix(".toml")
    folder = Path() if script is None else script.parent
    with PanicButton() as panic:
        workplace = _workplace(panic, taught, seed=seed, camera=camera, look=look, first=first)
        words = lambda: (*COMMANDS, *INSTRUCTIONS, *workplace.known.positions)  # noqa: E731
        lines = typed_lines("* ", panic.aside, words)
        typist = Typist(Repl(workplace=workplace, folder=folder))
        failed = converse(typist, lines, _say, json=json)
    return 0 if sys.stdin.isatty() else _code(failed)


def _workplace(
    panic: PanicButton, taught: Path | None, *, seed: int, camera: str, look: bool, first: Path | None
) -> "Workplace":
    """The cell to work in.

    Raises:
        InvalidInput: a file cannot be used, or the camera cannot work as asked.
    """
    from handeye.doing.workplace import Workplace
    from handeye.stepping.checkpoint_file import read_checkpoint
    from handeye.work.drive import Halted

    if first is not None:
        known = None if taught is None else load_taught(taught)
        return Workplace.at(read_checkpoint(first), known, panic)
    known = _taught(taught)
    try:
        return Workplace(seed=world(seed), camera=camera, taught=known, look=look, halt=panic)
    except Halted:
        raise KeyboardInterrupt from None


def _taught(file: Path | None) -> Taught:
    return load_taught(plans() / "water_pump.toml" if file is None else file)


def _code(failed: "Answer | None") -> int:
    """The exit code for the first answer that was not as wished."""
    if failed is None:
        return 0
    if failed.refused:
        return 2
    return 130 if failed.stopped == "panic" else 1


def _say(text: str) -> None:
    screen.print(text, markup=False, soft_wrap=True)
