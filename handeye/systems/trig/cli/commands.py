"""The commands of TRIG: programs are taught by doing the task, displayed as they grow, and run forwards and
backwards."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import App, Parameter

from handeye.cli.common import Json, WholeNumber, complain, note, put_json, say, screen
from handeye.cli.panic_button import PanicButton
from handeye.core.errors import BadArgument, InvalidInput, MissingExtra, Refused
from handeye.systems.trig.cli.jobs import bucket, palletise

if TYPE_CHECKING:
    from handeye.systems.trig.language.session import Session

ArmKind = Annotated[
    Literal["none", "purbrick"],
    Parameter(
        name="--arm",
        help="The arm: `none` is an ideal arm without physics; `purbrick` is the paper's arm, simulated. The same "
        "script can take different branches on the two arms.",
    ),
]
TrigFile = Annotated[
    Path,
    Parameter(help="A script of typed lines (.trig), or a program that the command W wrote (.trig.json)."),
]
ALL: Final = 1_000_000_000  # number of steps: more than can be recorded

trig = App(name="trig", help="TRIG (MIT, 1982): teach a program by example, watch it grow, run it backwards.")


def edit(
    file: Annotated[
        Path | None, Parameter(help="A program to load at the start: .trig or .trig.json.")
    ] = None,
    /,
    *,
    arm: ArmKind = "none",
) -> int:
    """Open the editor: type commands, drive the arm with the teach box, and see the program. HELP lists the commands.

    Exit code 0: you left; 2: bad input, or a piped line was refused; 130: interrupted.
    """
    from handeye.systems.trig.cli.sessions import opened

    with PanicButton() as panic:
        session = opened(arm, file, panic)
        if not at_terminal():
            return _piped(session, panic)
    return _conversed(session, arm)


def run(
    file: TrigFile,
    /,
    *,
    arm: ArmKind = "none",
    back: Annotated[
        bool, Parameter(help="When the program has ended, run it backwards to its start.")
    ] = False,
    json: Json = False,
) -> int:
    """Run a program from its first step. If FILE is a script, its lines are first typed one by one, as in the editor.

    Exit code 0: the program has ended and, with --back, everything is undone; 1: the arm stopped too early;
    2: bad input; 130: interrupted.
    """
    from handeye.systems.trig.cli.sessions import opened, watched
    from handeye.systems.trig.language.program_commands import told_run
    from handeye.systems.trig.language.reports import report

    with PanicButton() as panic:
        session = opened(arm, file, panic)
        tell = note if json else say
        try:
            with watched(session, panic):
                ways = [session.runner.run()]
            tell(told_run(ways[0]))
            if back and ways[0].end != "halted":
                with watched(session, panic):
                    ways.append(session.runner.back(ALL))
                tell(told_run(ways[1], back=True))
        except Refused as error:  # by the arm
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
    arm: ArmKind = "none",
    width: Annotated[
        WholeNumber, Parameter(help="Characters per line. Default: the width of the terminal.")
    ] = 0,
) -> int:
    """Show both displays of a program: the whole program in miniature, and its steps in full. If FILE is a script, its
    lines are first typed one by one, as in the editor.

    Exit code 0: shown; 2: bad input.
    """
    from handeye.systems.trig.cli.sessions import opened
    from handeye.systems.trig.language.display import full_display, partial_display
    from handeye.systems.trig.language.styled import plain, symbols_for

    if width and not 20 <= width <= 1000:
        raise BadArgument(f"a display must be 20 to 1000 characters wide, not {width}")
    with PanicButton() as panic:
        program = opened(arm, file, panic).program
    symbols, wide = symbols_for(sys.stdout.encoding), width or screen.width
    height = max(1, len(program.graph.nodes))
    for display in (full_display, partial_display):
        say(f"{plain(display(program, wide, height, symbols))}\n", whole=True)
    return 0


def at_terminal() -> bool:
    """Return True if standard input and output are a terminal."""
    return sys.stdin.isatty() and sys.stdout.isatty()


def _piped(session: "Session", halted: Callable[[], bool]) -> int:
    """Execute the lines of standard input, and print each question with its answer. A refused line is reported, and the
    next one is read.
    """
    from handeye.systems.trig.cli.sessions import PipedDesk
    from handeye.systems.trig.language.command_input import hear

    code = 0
    session.desk = script = PipedDesk(iter(sys.stdin.readline, ""), say, halted)
    while not session.over and (line := script.next_line()) is not None:
        try:
            hear(session, line)
        except InvalidInput as error:
            say(f"line {script.number}: {error}")
            code = 2
    return code


def _conversed(session: "Session", arm: str) -> int:
    """Run a session at a terminal. The session uses the full screen; if the screen library is missing, the session
    works line by line.
    """
    try:
        from handeye.systems.trig.cli.screen import PACE, Screen
    except ModuleNotFoundError:
        from handeye.systems.trig.cli.lines import converse

        missing = MissingExtra("trig", "prompt_toolkit", "terminal")
        note(f"{missing}; without this package you can type lines, but there is no screen")
        with PanicButton() as panic:
            converse(session, panic)
        return 0
    Screen(session, pace=PACE if arm == "none" else 0.0).run()
    return 0


trig.default(edit)
for _command in (run, show, palletise, bucket):
    trig.command(_command)
