"""The commands of SUPERSIGMA: run a MAL program, try its interleavings, explain words, and open the console."""

from functools import partial
from pathlib import Path
from typing import Annotated, Final

from cyclopts import App, Parameter

from handeye.cli.common import (
    WholeNumber,
    answer,
    note,
    positive,
    say,
)
from handeye.cli.judged_jobs import USUAL_RUN, RunOptions, carry_out_run
from handeye.cli.numbered import LinePrinter, converse, explain_word, show_check, shown_without_errors
from handeye.cli.runs import check_kept
from handeye.core.errors import BadArgument
from handeye.core.source import Source, read_source
from handeye.systems.sigma.cli.axis import axis
from handeye.systems.sigma.cli.borrow import borrow
from handeye.systems.sigma.cli.bridge import bridge
from handeye.systems.sigma.cli.bus import bus
from handeye.systems.sigma.cli.crash import crash
from handeye.systems.sigma.cli.diagnose import diagnose
from handeye.systems.sigma.cli.jobs import chess, handover, insert, line, prco
from handeye.systems.sigma.cli.moves import moves
from handeye.systems.sigma.cli.table1 import table1
from handeye.systems.sigma.mal.check import checked
from handeye.systems.sigma.mal.happenings import Printed
from handeye.systems.sigma.run.plan import LONGEST_STATEMENT_US, ArmName

MalFile = Annotated[Path, Parameter(help="A MAL program (`.mal`).")]
StatementTime = Annotated[
    WholeNumber,
    Parameter(
        name="--statement-us",
        help="Microseconds that the central computer takes for a statement; each calculation in the statement adds "
        "a quarter of this time.",
    ),
]
Arm = Annotated[
    ArmName,
    Parameter(
        name="--arm",
        help="What the program drives. `none`: perfect motors. `wired`: ten microcomputers on a bus run their "
        "firmware, and each microcomputer samples the wires of the bus with its own clock. `none` and `wired` have "
        "no obstacles. `gantries`: the same microcomputers, and a simulated machine with two gantries over an empty "
        "board.",
    ),
]

sigma = App(
    name="sigma",
    help="SUPERSIGMA (Milan, 1981): programs in MAL, whose tasks run in parallel and are synchronised by flags.\n\n"
    "Without a command, `handeye sigma` opens the console of 1981.",
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
    options: RunOptions = USUAL_RUN,
) -> int:
    """Run a program. In the stepper, a step is one statement of the task whose turn it is.

    Exit code 0: all tasks have ended; 1: the program stopped before its end (an abort, a deadlock, or a statement
    that cannot be executed); 2: bad input; 130: interrupted.
    """
    from handeye.core.variation import WorldSpec
    from handeye.runs.setup import Setup
    from handeye.systems.sigma.run.plan import MalPlan, sound

    check_kept(options.no_keep, options.out)
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
    judged = arm != "gantries"  # whatever a program does to the gantries is neither right nor wrong
    setup = Setup(system="sigma", plan=plan, world=WorldSpec(seed=seed), camera="auto", judged=judged)
    return carry_out_run(setup, options, (Printer(note if options.json else say),), judged=judged)


Printer = partial(LinePrinter, Printed)
"""Prints the output of a program."""


def reported(source: Source) -> bool:
    """Print the mistakes of a program. Returns True if there are no errors."""
    return shown_without_errors(checked(source)[1], source)


def check(
    file: MalFile,
    /,
    *,
    interleavings: Annotated[
        bool,
        Parameter(
            help="Try every order in which the tasks may run. Show what can go wrong, and an order in which it goes "
            "wrong."
        ),
    ] = False,
    most: Annotated[
        WholeNumber | None,
        Parameter(
            help="With --interleavings: stop after visiting this number of different states of the program. "
            "Default: 50000."
        ),
    ] = None,
    json: Annotated[bool, Parameter(help="Print the findings as JSON.")] = False,
) -> int:
    """Check a program as `handeye check` does, and try the orders in which its tasks may run.

    Statements are executed one at a time; motions and delays may take any time. Sensors answer 0, INPUT reads 0, and
    no motion is aborted.

    Exit code 0: nothing was found; 1: there is a deadlock, a race, or a statement that cannot be executed; 2: bad
    input, or a program with errors.
    """
    from handeye.systems.sigma.mal.compiler import program_of
    from handeye.systems.sigma.mal.interleavings import MOST_STATES, told_orders
    from handeye.systems.sigma.mal.interleavings import interleavings as tried

    if most is not None:
        positive(most, "state")
        if not interleavings:
            raise BadArgument("--most applies only to --interleavings")
    source = read_source(file)
    if not interleavings:
        return show_check(file, checked(source)[1], source, json=json)
    if not reported(source):
        return 2
    program = program_of(file.name, source.text, line=True)
    if not program.lines:
        raise BadArgument(f"{file} has no line that can be executed")
    result = tried(program, most or MOST_STATES)
    answer(result, told_orders(str(file), program, result), json=json)
    return 1 if result.findings else 0


def words(word: str | None = None, /) -> int:
    """Explain a word of MAL. Without a word, list all words.

    Parameters
    ----------
    word
        The word, such as MOVE, TAKE or BEAM.
    """
    from handeye.systems.sigma.mal.words import WORDS, explained

    usages = {
        f"{kind}s": [each.usage for each in WORDS.values() if each.kind == kind]
        for kind in ("statement", "part", "function", "operator")
    }
    return explain_word(
        word, usages, explained, known=WORDS, noun="a word of MAL", command="handeye sigma words"
    )


def console(
    file: Annotated[Path | None, Parameter(help="A MAL program (`.mal`) to load at the start.")] = None, /
) -> int:
    """Open the console of 1981: type the numbered lines of a program, or a command such as RUN; HELP lists the
    commands.

    Exit code 0: you left; 2: bad input, or a piped line was refused; 130: interrupted.
    """
    from handeye.systems.sigma.cli.console import Console

    return converse(partial(Console, say), "* ", () if file is None else (f"LOAD {file}",))


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
