"""Commands for programming by doing: `do` executes instructions at once, `repl` collects a program line by line,
and `teach` moves the arm to positions and names them.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Calibrate, Camera, Json, Overwrite, note, put_line, say
from handeye.cli.panic_button import PanicButton
from handeye.cli.prompt import typed_lines
from handeye.cli.world_options import ANY_WORLD, Faults, WorldOptions, broken
from handeye.core.errors import BadArgument
from handeye.core.files import Kind, beside, check_place, is_there
from handeye.core.source import read_source
from handeye.program.taught import Taught, load_taught
from handeye.runs.scripts import default_script
from handeye.runs.scripts import taught as taught_for
from handeye.tasks import planned

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from handeye.runs.observer import Observer
    from handeye.runs.runner import Runner
    from handeye.teaching.answers import Answer
    from handeye.teaching.teacher import Teacher
    from handeye.teaching.workplace import Workplace

TaughtFile = Annotated[
    Path | None,
    Parameter(name="--taught", help="Taught file. Default: the taught file that `assemble` uses."),
]
Looking = Annotated[bool, Parameter(name="--look", help="Calibrate the camera first, as `assemble` does.")]
From = Annotated[
    Path | None, Parameter(name="--from", help="Start with the cell in the state of this checkpoint.")
]
Keep = Annotated[Path | None, Parameter(help="At the end, save the state of the cell as this checkpoint.")]


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class CellOptions:
    """The work cell, with the faults in the cell and the taught positions."""

    world: Annotated[WorldOptions, Parameter(name="*")] = ANY_WORLD
    fault: Faults = None
    taught: TaughtFile = None
    look: Looking = False
    calibrate: Calibrate = False
    first: From = None
    camera: Camera = "auto"

    def workplace(
        self,
        panic: "Callable[[], bool]",
        taught: Taught | None,
        observers: "Callable[[Runner], Sequence[Observer]]" = lambda _: (),
    ) -> "Workplace":
        """Build the workplace; raises InvalidInput if a file, an option or the camera cannot be used."""
        from handeye.execution.servo import Halted
        from handeye.runs.checkpoint_file import read_checkpoint
        from handeye.teaching.workplace import Workplace

        if self.first is not None and (self.world.chosen or self.fault):
            raise BadArgument(
                f"{self.first} has its own world; --seed, --level, --without, --set, --scale and --fault cannot be "
                "given with --from"
            )
        if self.first is not None:
            return Workplace.at(read_checkpoint(self.first), taught, panic, observers)
        work = planned(self.world.work)
        try:
            return Workplace(
                world=broken(self.world.spec, self.fault, work),
                camera=self.camera,
                taught=taught_for(default_script(work), work) if taught is None else taught,
                task=work.name,
                look=self.look,
                calibrate=self.calibrate,
                halt=panic,
                observers=observers,
            )
        except Halted:
            raise KeyboardInterrupt from None


ANY_CELL: Final = CellOptions()


def do(
    *functions: str,
    cell: CellOptions = ANY_CELL,
    keep: Keep = None,
    overwrite: Overwrite = False,
    json: Json = False,
) -> int:
    """Plan instructions and run them immediately, one after the other: `handeye do "OPEN 3" PARK`.

    Exit code 0: done; 1: the program called the operator; 2: bad input; 130: interrupted.

    Parameters
    ----------
    functions
        Instructions of the arm language; a modifier and its motion are one argument, with the modifier first and a
        newline between them.
    """
    from handeye.runs.checkpoint_file import CHECKPOINT, write_checkpoint
    from handeye.teaching.answers import converse
    from handeye.teaching.repl import Repl

    if not all(map(str.strip, functions or ("",))):
        raise BadArgument('give an instruction, such as `handeye do "OPEN 3"`')
    if keep is not None:
        check_place(keep, CHECKPOINT, overwrite=overwrite)
    with PanicButton() as panic:
        workplace = cell.workplace(panic, None if cell.taught is None else load_taught(cell.taught))
        lines = (f"DO {function}" for function in functions)
        repl = Repl(workplace=workplace, folder=Path(), called=_kept(keep))
        failed = converse(repl, lines, put_line if json else say, json=json, strict=True)
    if failed is not None and "modifier-without-motion" in {d.code for d in failed.diagnostics}:
        note("a modifier and its motion must be one argument: handeye do $'STOP 50\\nCHANGE Z -1'")
    if keep is not None and (failed is None or not failed.refused):
        write_checkpoint(keep, workplace.checkpoint())
    return _code(failed)


def repl(
    script: Path | None = None,
    /,
    *,
    cell: CellOptions = ANY_CELL,
    json: Json = False,
) -> int:
    """Type instructions, which are checked and collected; DO runs them. HELP lists the commands.

    Exit code 0: you left; 1: the last program called the operator; 2: bad input, or a piped line was refused;
    130: interrupted.

    Parameters
    ----------
    script
        A script. handeye uses the taught file next to it; `DO NAME` looks for the program NAME in the same folder.
    """
    from handeye.al.instructions import INSTRUCTIONS
    from handeye.teaching.answers import converse
    from handeye.teaching.repl import COMMANDS, Repl

    taught = cell.taught
    if script is not None and taught is None and is_there(beside(script, ".toml")):
        taught = beside(script, ".toml")
    folder = Path() if script is None else script.parent
    with PanicButton() as panic:
        workplace = cell.workplace(panic, None if taught is None else load_taught(taught))
        lines = typed_lines("* ", panic.aside, lambda: (*COMMANDS, *INSTRUCTIONS, *workplace.known.positions))
        typist = Repl(workplace=workplace, folder=folder)
        failed = converse(typist, lines, put_line if json else say, json=json)
    return 0 if sys.stdin.isatty() else _code(failed)


def teach(
    file: Path,
    /,
    *,
    world: WorldOptions = ANY_WORLD,
    fault: Faults = None,
    first: From = None,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Move the arm and name positions; new names are added to the taught file, and the rest of the file is kept.

    Exit code 0: you left; 2: bad input, a piped line was refused, or names were not saved;
    130: interrupted.

    Parameters
    ----------
    file
        The taught file (TOML), or the script next to it. The taught file need not exist yet.
    """
    from handeye.teaching.answers import converse
    from handeye.teaching.teach_commands import TEACH_COMMANDS, TeachSession

    with PanicButton() as panic:
        cell = CellOptions(world=world, fault=fault, camera=camera, first=first)
        teacher = teacher_of(file, panic, cell)
        workplace = teacher.workplace
        lines = typed_lines(
            "teach> ",
            panic.aside,
            lambda: (*TEACH_COMMANDS, *workplace.taught.positions, *workplace.taught.parts),
        )
        failed = converse(TeachSession(teacher), lines, put_line if json else say, json=json)
    refused = failed is not None and not sys.stdin.isatty()
    return 2 if refused or left_unsaved(teacher) else 0


_TAUGHT_FILE: Final = Kind("taught file", rb"")


def teacher_of(
    file: Path,
    panic: "Callable[[], bool]",
    cell: CellOptions,
    observers: "Callable[[Runner], Sequence[Observer]]" = lambda _: (),
) -> "Teacher":
    """A teacher for a cell and a taught file. `file` is the taught file, or the script next to it. Raises InvalidInput
    if the cell or the file cannot be used.
    """
    from handeye.teaching.teacher import Teacher

    path = file if file.suffix == ".toml" else beside(file, ".toml")
    text = read_source(path).text if is_there(path) else ""
    known = load_taught(path) if is_there(path) else Taught()
    check_place(path, _TAUGHT_FILE)  # before anything is taught that could not be saved
    return Teacher(workplace=cell.workplace(panic, known, observers), file=path, saved=text)


def left_unsaved(teacher: "Teacher") -> bool:
    """True if some taught names are not in the file; these names are then printed."""
    if teacher.unsaved:
        note(f"not saved: {', '.join(teacher.unsaved)}")
    return bool(teacher.unsaved)


def _kept(file: Path | None) -> str:
    """Advice if the program has called the operator, but no person can answer."""
    if file is None:
        return "with --keep FILE, `handeye do` saves the cell at the end, and --from FILE continues from the saved cell"
    return f"`handeye do --from {file}` continues from the saved cell"


def _code(failed: "Answer | None") -> int:
    """The exit code for the first answer that was not a success."""
    if failed is None:
        return 0
    if failed.refused:
        return 2
    return 130 if failed.stopped == "panic" else 1
