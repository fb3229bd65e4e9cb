"""The commands of MOS and ML: run and check a program, assemble a symbolic program, and open the terminal of 1975."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Annotated, Final

from cyclopts import App, Parameter

from handeye.cli.common import Overwrite, WholeNumber, note, say
from handeye.cli.judged_jobs import USUAL_RUN, RunOptions, carry_out_run
from handeye.cli.numbered import Ask, LinePrinter, converse, explain_word, show_check, shown_without_errors
from handeye.cli.runs import check_kept
from handeye.core.errors import BadArgument
from handeye.core.files import check_new, write_whole
from handeye.core.source import Source, read_source
from handeye.systems.ml.cli.follow import follow
from handeye.systems.ml.cli.parts import orient, take_from_bin
from handeye.systems.ml.cli.support import support, typewriter
from handeye.systems.ml.cli.tables import tables
from handeye.systems.ml.cli.touch import touch
from handeye.systems.ml.cli.toys import blocks, train
from handeye.systems.ml.cli.view import view
from handeye.systems.ml.happenings import Printed
from handeye.systems.ml.language.check import checked
from handeye.systems.ml.run.plan import ArmName

MlFile = Annotated[Path, Parameter(help="An ML program (`.ml`).")]

ml = App(
    name="ml",
    help="ML (IBM, 1975): motions that stop when a sensor, read every 10 ms, passes a limit.",
)


def run(
    file: MlFile,
    /,
    *,
    arm: Annotated[
        ArmName,
        Parameter(
            help="The machine. `none`: perfect motors, which nothing obstructs. `rectilinear`: the simulated arm over "
            "an empty table, with the wand in its left finger."
        ),
    ] = "none",
    seed: Annotated[
        WholeNumber,
        Parameter(help="Seed of the world of `--arm rectilinear`: it determines the errors of the arm."),
    ] = 0,
    first: Annotated[
        WholeNumber | None,
        Parameter(help="The statement at which the program begins. Default: the first statement."),
    ] = None,
    left: Annotated[
        WholeNumber | None,
        Parameter(
            help="The statement at which the program of the left arm begins. The programs of both arms run at the same "
            "time. With `--arm rectilinear`, the left arm is a Purbrick arm beside the right one. Default: there is no "
            "left arm."
        ),
    ] = None,
    sense: Annotated[
        list[str] | None,
        Parameter(
            help="What a sensor or an interlock reads. `8=1200`: sensor 8 reads 1200. `panic=1`: the panic button "
            "is pressed. `5=500@3:2750`: sensor 5 reads 500 while motor 3 is at 2750 or farther away from 0. "
            "`door=1@.5s`: the door is open from .5 s on. Give --sense once for each reading."
        ),
    ] = None,
    options: RunOptions = USUAL_RUN,
) -> int:
    """Run a program. The arm is enabled first. The stepper counts each statement as one step.

    Exit code 0: the program has ended; 1: an error or an emergency has stopped it; 2: bad input; 130: interrupted.
    """
    from handeye.core.variation import WorldSpec
    from handeye.runs.setup import Setup
    from handeye.systems.ml.cli.senses import sensed
    from handeye.systems.ml.run.plan import MlPlan, sound

    check_kept(options.no_keep, options.out)
    check_machine(arm, seed=seed, sense=sense)
    stimuli = tuple(sensed(each) for each in sense or ())
    source = read_source(file)
    if not reported(source, first=first, left=left):
        return 2
    plan = MlPlan(name=file.name, text=source.text, arm=arm, first=first, left=left, stimuli=stimuli)
    sound(plan)
    judged = arm == "none"  # whatever a program does to an empty table is neither right nor wrong
    setup = Setup(system="ml", plan=plan, world=WorldSpec(seed=seed), camera="auto", judged=judged)
    return carry_out_run(setup, options, (Printer(note if options.json else say),), judged=judged)


def check_machine(arm: ArmName, *, seed: int, sense: list[str] | None) -> None:
    """Raise BadArgument if an option does not apply to the machine of the run."""
    if arm == "none":
        if seed:
            raise BadArgument("--seed applies only to `--arm rectilinear`: perfect motors have no errors")
    elif sense:
        raise BadArgument("--sense applies only to `--arm none`: the rectilinear arm has sensors of its own")


Printer = partial(LinePrinter, Printed)
"""Prints the output of a program."""


def reported(source: Source, *, first: int | None, left: int | None) -> bool:
    """Print the mistakes of a program. Returns True if there are no errors."""
    return shown_without_errors(checked(source, first=first, left=left)[1], source)


def check(
    file: Annotated[Path, Parameter(help="An ML program (`.ml`) or a symbolic program (`.sym`).")],
    /,
    *others: Annotated[
        Path,
        Parameter(
            help=(
                "Further symbolic files. FILE and these files, in this order, are assembled as one program."
            )
        ),
    ],
    json: Annotated[bool, Parameter(help="Print the findings as JSON.")] = False,
) -> int:
    """Check a program as `handeye check` does: its form, its jumps, and how it uses its sensors. In a symbolic program,
    only its form and its names are checked.

    Exit code 0: no errors; 2: bad input, or a program with errors.
    """
    from handeye.systems.ml.language.assembler import assembled, decks

    symbolic = file.suffix.lower() == ".sym"
    if others and not symbolic:
        raise BadArgument("only symbolic programs (.sym) can consist of several files")
    source = decks([file, *others])
    return show_check(file, (assembled if symbolic else checked)(source)[1], source, json=json)


def assemble(
    file: Annotated[Path, Parameter(help="A symbolic program, `.sym`.")],
    /,
    *others: Annotated[
        Path,
        Parameter(
            help=(
                "Further symbolic files. The first file and these files, in this order, are assembled as one program."
            )
        ),
    ],
    out: Annotated[
        Path | None,
        Parameter(name=["--out", "-o"], help="File for the program in ML. Default: print the program."),
    ] = None,
    overwrite: Overwrite = False,
) -> int:
    """Assemble a symbolic program: replace the names of statements, variables and sensors by their numbers.

    Exit code 0: the program was assembled; 2: bad input, or a program with errors.
    """
    from handeye.systems.ml.language.assembler import assembled, decks

    source = decks([file, *others])
    text, found = assembled(source)
    if not shown_without_errors(found, source):
        return 2
    if out is None:
        say(text.removesuffix("\n"), whole=True)
        return 0
    if not overwrite:
        check_new(out)
    write_whole(out, text.encode())
    return 0


def words(word: str | None = None, /) -> int:
    """Explain a command of ML. Without a command, list all commands.

    Parameters
    ----------
    word
        The command, such as MOVE, SENSOR or MT.
    """
    from handeye.systems.ml.language.commands import COMMANDS, explained

    usages: dict[str, list[str]] = {}
    for each in COMMANDS.values():
        usages.setdefault(f"{each.category} commands", []).append(each.form)
    return explain_word(
        word, usages, explained, known=COMMANDS, noun="a command of ML", command="handeye ml words"
    )


def console(
    file: Annotated[Path | None, Parameter(help="An ML program (`.ml`) to load at the start.")] = None,
    /,
    *,
    left: Annotated[
        bool,
        Parameter(
            help="Install a left arm, too. LEFT and RIGHT then choose an arm. The left arm is slower and has fewer "
            "motors."
        ),
    ] = False,
) -> int:
    """Open the terminal of 1975: lines with a number are stored, and all others are executed at once. ENABLE switches
    the pump on, RUN and TRY run the program, EXIT leaves, and HELP lists the commands.

    Exit code 0: you left; 2: bad input, or a piped line was refused; 130: interrupted.
    """
    return _session(file, left=left)


def try_program(file: MlFile, /) -> int:
    """Load a program at the terminal, enable the arm, and run the program one statement at a time.

    Exit code 0: you left; 2: bad input, or a piped line was refused; 130: interrupted.
    """
    return _session(file, "ENABLE", "TRY")


def _session(file: Path | None, *typed: str, left: bool = False) -> int:
    """Execute the lines in `typed`, and then the lines that the user enters at the prompt. Returns the exit code."""
    from handeye.systems.ml.cli.console import Console

    def begin(ask: Ask, halted: Callable[[], bool]) -> Console:
        session = Console(say, ask, halted, left=left)
        if file is not None:
            session.load(read_source(file))
        return session

    return converse(begin, "READY ", typed, echo=True)


_COMMANDS: Final = (
    run, check, assemble, words, tables, view, touch, follow, blocks, train, support, orient, typewriter,
)  # fmt: skip
ml.default(console)
for _command in _COMMANDS:
    ml.command(_command)
ml.command(take_from_bin, name="bin")
ml.command(try_program, name="try")
