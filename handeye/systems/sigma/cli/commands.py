"""The commands of SUPERSIGMA: run a MAL program, try its interleavings, explain words, and open the console."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Final

from cyclopts import App, Parameter

from handeye.cli.common import (
    Details,
    Json,
    NoKeep,
    Out,
    Overwrite,
    WholeNumber,
    answer,
    note,
    positive,
    say,
    show,
)
from handeye.cli.runs import Break, Live, OnStop, Step, check_kept
from handeye.core.diagnostics import has_errors, quoted, suggestion
from handeye.core.errors import BadArgument, InvalidInput, NoSuchName
from handeye.core.source import Source, read_source
from handeye.program.events import AnyEvent
from handeye.runs.observer import Observer
from handeye.systems.sigma.cli.axis import axis
from handeye.systems.sigma.cli.borrow import borrow
from handeye.systems.sigma.cli.bridge import bridge
from handeye.systems.sigma.cli.bus import bus
from handeye.systems.sigma.cli.chess import chess
from handeye.systems.sigma.cli.crash import crash
from handeye.systems.sigma.cli.diagnose import diagnose
from handeye.systems.sigma.cli.handover import handover
from handeye.systems.sigma.cli.insert import insert
from handeye.systems.sigma.cli.line import line
from handeye.systems.sigma.cli.moves import moves
from handeye.systems.sigma.cli.prco import prco
from handeye.systems.sigma.cli.table1 import table1
from handeye.systems.sigma.mal.check import checked
from handeye.systems.sigma.mal.happenings import Printed
from handeye.systems.sigma.run.plan import LONGEST_STATEMENT_US, ArmName

MalFile = Annotated[Path, Parameter(help="A program in MAL, `.mal`.")]
StatementTime = Annotated[
    WholeNumber,
    Parameter(
        name="--statement-us",
        help="Microseconds that the central computer takes for a statement; each calculation in the statement adds "
        "a quarter.",
    ),
]
Arm = Annotated[
    ArmName,
    Parameter(
        name="--arm",
        help="The machine: `none` has perfect motors; `wired` has ten microcomputers with their firmware, on a bus "
        "whose wires they sample with their own clocks. Neither of these machines has obstacles. `gantries` has the "
        "same "
        "microcomputers, and the simulated machine: two gantries over an empty board.",
    ),
]

sigma = App(
    name="sigma",
    help="SUPERSIGMA (Milan, 1981): programs of parallel tasks and flags in MAL.\n\nWithout a command, `handeye sigma` "
    "opens the console of 1981.",
)


def run(
    file: MalFile,
    /,
    *,
    arm: Arm = "none",
    seed: Annotated[
        WholeNumber,
        Parameter(help="Seed of the world of `--arm gantries`: it determines the errors of the machine."),
    ] = 0,
    statement_us: StatementTime = 2000,
    json: Json = False,
    details: Details = False,
    out: Out = None,
    overwrite: Overwrite = False,
    no_keep: NoKeep = False,
    breaks: Break = None,
    step: Step = False,
    live: Live = False,
    on_stop: OnStop = None,
) -> int:
    """Run a program: a step is one statement of the task whose turn it is.

    Exit code 0: all tasks have ended; 1: the program stopped before its end (an abort, a deadlock, or a statement
    that cannot be executed); 2: bad input; 130: interrupted.
    """
    from handeye.cli.job import Job, work
    from handeye.core.variation import WorldSpec
    from handeye.runs.setup import Setup
    from handeye.runs.snapshot import Checkpoint
    from handeye.systems.sigma.run.plan import MalPlan, sound

    check_kept(no_keep, out)
    if not 0 <= statement_us <= LONGEST_STATEMENT_US:
        raise BadArgument(f"--statement-us must be between 0 and {LONGEST_STATEMENT_US}, not {statement_us}")
    if seed and arm != "gantries":
        raise BadArgument(
            f"--seed applies only to `--arm gantries`: the machine of `--arm {arm}` has no errors"
        )
    source = read_source(file)
    plan = MalPlan(name=file.name, text=source.text, arm=arm, statement_us=statement_us)
    if not reported(source):
        return 2
    sound(plan)
    judged = arm != "gantries"  # what any program does to the gantries is neither right nor wrong
    setup = Setup(system="sigma", plan=plan, world=WorldSpec(seed=seed), camera="auto", judged=judged)
    return work(
        Job(
            start=Checkpoint(setup=setup), out=out, keep=not (no_keep or step), details=details, overwrite=overwrite,
            breaks=breaks or (), step=step, live=live,
            on_stop=on_stop, json=json, referee=judged, listening=() if step else (Printer(note if json else say),),
        )
    )  # fmt: skip


class Printer(Observer):
    """Prints the output of a program."""

    def __init__(self, put: Callable[[str], None]) -> None:
        self._put = put

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, Printed):
            self._put(event.text)


def reported(source: Source) -> bool:
    """Print the mistakes of a program. Returns True if there are no errors."""
    found = checked(source)[1]
    show(found, source, json=False)
    return not has_errors(found)


def check(
    file: MalFile,
    /,
    *,
    interleavings: Annotated[
        bool,
        Parameter(
            help="Try every order in which the tasks may run, and show what can go wrong in which order."
        ),
    ] = False,
    most: Annotated[
        WholeNumber, Parameter(help="Stop after visiting this number of different states of the program.")
    ] = 50_000,
    json: Annotated[bool, Parameter(help="Print the findings as JSON.")] = False,
) -> int:
    """Check a program as `handeye check` does, and try the orders of its tasks.

    Statements are executed one at a time; motions and delays may take any time. Sensors answer 0, INPUT reads 0, and no
    motor is aborted.

    Exit code 0: nothing was found; 1: there is a deadlock, a race, or a statement that cannot be executed; 2: bad
    input, or a program with errors.
    """
    from handeye.systems.sigma.mal.compiler import program_of
    from handeye.systems.sigma.mal.interleavings import interleavings as tried
    from handeye.systems.sigma.mal.interleavings import told_orders

    positive(most, "state")
    source = read_source(file)
    if not interleavings:
        found = checked(source)[1]
        show(found, source, json=json)
        if not found and not json:
            say(f"{file}: no errors")
        return 2 if has_errors(found) else 0
    if not reported(source):
        return 2
    program = program_of(file.name, source.text, line=True)
    if not program.lines:
        raise BadArgument(f"{file} has no line that can be executed")
    result = tried(program, most)
    answer(result, told_orders(str(file), program, result), json=json)
    return 1 if result.findings else 0


def words(word: str | None = None, /) -> int:
    """Explain a word of MAL; without a word, list all.

    Parameters
    ----------
    word
        The word, such as MOVE, TAKE or BEAM.
    """
    from handeye.systems.sigma.mal.words import WORDS, explained

    if word is None:
        for kind in ("statement", "part", "function", "operator"):
            say(f"{kind}s")
            for each in WORDS.values():
                if each.kind == kind:
                    say(f"  {each.usage}", whole=True)
        return 0
    text = explained(word)
    if text is None:
        near = suggestion(word.upper(), WORDS)
        raise NoSuchName(
            f"{quoted(word)} is not a word of MAL"
            + (f"; {near}" if near else "; `handeye sigma words` lists them")
        )
    say(text)
    return 0


def console(
    file: Annotated[Path | None, Parameter(help="A program in MAL to load at the start, `.mal`.")] = None, /
) -> int:
    """Open the console of 1981: type a program by numbered lines, and NEW LOAD SAVE LIST COMPILE RUN BREAK STATUS.

    Exit code 0: you left; 2: bad input, or a piped line was refused; 130: interrupted.
    """
    from handeye.cli.panic_button import PanicButton
    from handeye.cli.prompt import typed_lines
    from handeye.systems.sigma.cli.console import Console

    terminal, code = sys.stdin.isatty(), 0
    with PanicButton() as panic:

        def asked(prompt: str) -> str | None:
            return next(typed_lines(prompt if terminal else "", panic.aside, lambda: ()), None)

        session = Console(say, asked, panic)
        if file is not None:
            session.hear(f"LOAD {file}")
        lines = typed_lines("* " if terminal else "", panic.aside, session.words)
        for line in lines:
            try:
                session.hear(line)
            except InvalidInput as error:
                say(str(error))
                code = 2
            if session.over:
                break
    return 0 if terminal else code


_COMMANDS: Final = (
    run,
    check,
    words,
    axis,
    bus,
    crash,
    chess,
    handover,
    insert,
    prco,
    line,
    bridge,
    borrow,
    moves,
    table1,
    diagnose,
)
sigma.default(console)
for _command in _COMMANDS:
    sigma.command(_command)
