"""Commands of TRIG: programs taught by doing, drawn as they grow, and run forwards and backwards."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import App, Parameter

from handeye.cli.common import Json, WholeNumber, complain, note, put_json, say, screen
from handeye.cli.panic_button import PanicButton
from handeye.errors import InvalidInput
from handeye.extras import MissingExtra
from handeye.source import read_source

if TYPE_CHECKING:
    from handeye.trig.running import Ran
    from handeye.trig.session import Session

ArmKind = Annotated[
    Literal["none"],
    Parameter(
        name="--arm",
        help="The arm. `none` is one that is only imagined, with the blocks that a script puts there.",
    ),
]
TrigFile = Annotated[
    Path, Parameter(help="A script of typed lines (.trig), or a program that W has written (.trig.json).")
]
ALL: Final = 1_000_000_000
"""Steps: more than are ever remembered."""

trig = App(
    name="trig", help="TRIG (MIT, 1982): teach a program by doing, see it as it grows, run it backwards."
)


def register(app: App) -> None:
    """Add the commands to the command line."""
    trig.default(edit)
    for command in (run, show):
        trig.command(command)
    app.command(trig)


def edit(
    file: Annotated[Path | None, Parameter(help="A program to begin with: .trig or .trig.json.")] = None,
    /,
    *,
    arm: ArmKind = "none",
) -> int:
    """Open the editor: type commands, drive the arm with the teach box, and see the program. HELP lists the commands.

    Exit code 0: left; 2: bad input, or a line that was piped in was refused; 130: interrupted.
    """
    if at_terminal():
        return _conversed(file)
    with PanicButton() as panic:
        return _piped(file, panic)


def run(
    file: TrigFile,
    /,
    *,
    arm: ArmKind = "none",
    back: Annotated[bool, Parameter(help="Then run it backwards, to where it began.")] = False,
    json: Json = False,
) -> int:
    """Run a program from the top; a script is typed first, line by line, as by somebody at the editor.

    Exit code 0: the program has ended, and with --back everything is undone; 1: the arm was stopped before;
    2: bad input; 130: interrupted.
    """
    from handeye.trig.reports import report
    from handeye.trig.teachable import OutOfTravel

    with PanicButton() as panic:
        session = _loaded(file, panic)
        runner, ways = session.runner, []
        try:
            ways.append(_told(runner.run(), back=False, json=json))
            if back and ways[0].end != "halted":
                ways.append(_told(runner.back(ALL), back=True, json=json))
        except OutOfTravel as error:
            complain(error)
            return 1
    if json:
        put_json(report(session, ways))
    if ways[-1].end == "halted":
        raise KeyboardInterrupt
    return 0 if ways[-1].end in ("none", "beginning") else 1


def show(
    file: TrigFile,
    /,
    *,
    width: Annotated[
        WholeNumber, Parameter(help="Characters of a line; by default those of the terminal.")
    ] = 0,
) -> int:
    """Show both displays of a program: all of it in miniature, and its steps in full.

    Exit code 0: shown; 2: bad input.
    """
    from handeye.trig.full_display import full_display
    from handeye.trig.partial_display import partial_display
    from handeye.trig.styled import plain
    from handeye.trig.symbols import symbols_for

    if width and not 20 <= width <= 1000:
        raise InvalidInput(f"a display is 20 to 1000 characters wide, not {width}")
    with PanicButton() as panic:
        program = _loaded(file, panic).program
    symbols, wide = symbols_for(sys.stdout.encoding), width or screen.width
    height = max(1, len(program.graph.nodes))
    for display in (full_display, partial_display):
        say(f"{plain(display(program, wide, height, symbols))}\n", whole=True)
    return 0


def at_terminal() -> bool:
    """Whether somebody sits at a terminal who can type and see."""
    return sys.stdin.isatty() and sys.stdout.isatty()


def _loaded(file: Path, halted: Callable[[], bool]) -> "Session":
    """A session in which a script has been typed, or a program read.

    Raises:
        InvalidInput: it cannot be.
    """
    from handeye.trig.no_arm import NoArm
    from handeye.trig.script import Script, type_script
    from handeye.trig.session import Session
    from handeye.trig.storage import ENDING, read_program

    if file.name.endswith(ENDING):
        return Session(arm=NoArm(), desk=Script((), note, halted), program=read_program(file), file=file)
    script = Script(read_source(file).text.splitlines(), halted=halted)
    session = Session(arm=NoArm(), desk=script)
    type_script(session, script, str(file))
    return session


def _piped(file: Path | None, halted: Callable[[], bool]) -> int:
    """Hear the lines of standard input; one that is refused is told, and the next is heard."""
    from handeye.trig.hearing import hear
    from handeye.trig.no_arm import NoArm
    from handeye.trig.script import Script
    from handeye.trig.session import Session

    script, code = Script(iter(sys.stdin.readline, ""), say, halted), 0
    session = Session(arm=NoArm(), desk=script) if file is None else _loaded(file, halted)
    session.desk = script
    while not session.over and (line := script.next_line()) is not None:
        try:
            hear(session, line)
        except InvalidInput as error:
            say(f"line {script.number}: {error}")
            code = 2
    return code


def _conversed(file: Path | None) -> int:
    """Converse with somebody at a terminal: on a screen, or line by line where that cannot be had."""
    from handeye.trig.no_arm import NoArm
    from handeye.trig.script import Script
    from handeye.trig.session import Session

    with PanicButton() as panic:
        session = Session(arm=NoArm(), desk=Script(())) if file is None else _loaded(file, panic)
    session.over = False
    try:
        from handeye.cli.trig_screen import Screen
    except ModuleNotFoundError:
        from handeye.cli.trig_lines import converse

        note(
            f"{MissingExtra('trig', 'prompt_toolkit', 'terminal')}; without it there are lines and no screen"
        )
        with PanicButton() as panic:
            converse(session, panic)
        return 0
    Screen(session).run()
    return 0


def _told(ran: "Ran", *, back: bool, json: bool) -> "Ran":
    from handeye.trig.cursor_commands import told_run

    (note if json else say)(told_run(ran, back=back))
    return ran
