"""Commands of SUPERSIGMA: carry a MAL program out, try its interleavings, the words, and the console."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Final

from cyclopts import App, Parameter

from handeye.cli.common import Details, Json, NoKeep, Out, Overwrite, WholeNumber, note, say, show
from handeye.cli.runs import Break, Live, OnStop, Step, check_kept
from handeye.core.diagnostics import has_errors, quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.source import Source, read_source
from handeye.program.events import AnyEvent
from handeye.runs.observer import Observer
from handeye.systems.sigma.mal.happenings import Printed
from handeye.systems.sigma.run.plan import LONGEST_STATEMENT_US, ArmName

MalFile = Annotated[Path, Parameter(help="A program in MAL, `.mal`.")]
StatementTime = Annotated[
    WholeNumber,
    Parameter(
        name="--statement-us",
        help="Microseconds that the central computer takes for a statement; a calculation takes a quarter more each.",
    ),
]
Arm = Annotated[
    ArmName,
    Parameter(name="--arm", help="The machine: `none` has perfect motors, and nothing stands in their way."),
]

sigma = App(name="sigma", help="SUPERSIGMA (Milan, 1981): programs of parallel tasks and flags in MAL.")


def run(
    file: MalFile,
    /,
    *,
    arm: Arm = "none",
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
    """Carry out a program: a step is one statement of the task whose turn it is.

    Exit code 0: all tasks have ended; 1: the program stands (an abort, a deadlock, a statement that cannot be carried
    out); 2: bad input; 130: interrupted.
    """
    from handeye.cli.job import Job, work
    from handeye.core.variation import WorldSpec
    from handeye.runs.setup import Setup
    from handeye.runs.snapshot import Checkpoint
    from handeye.systems.sigma.run.plan import MalPlan, sound

    check_kept(no_keep, out)
    if not 0 <= statement_us <= LONGEST_STATEMENT_US:
        raise BadArgument(f"--statement-us takes 0 to {LONGEST_STATEMENT_US}, not {statement_us}")
    source = read_source(file)
    plan = MalPlan(name=file.name, text=source.text, arm=arm, statement_us=statement_us)
    if not reported(source):
        return 2
    sound(plan)
    setup = Setup(system="sigma", plan=plan, world=WorldSpec(seed=0), camera="auto", judged=True)
    return work(
        Job(
            start=Checkpoint(setup=setup), out=out, keep=not (no_keep or step), details=details, overwrite=overwrite,
            breaks=breaks or (), step=step, live=live,
            on_stop=on_stop, json=json, referee=True, listening=() if step else (Printer(note if json else say),),
        )
    )  # fmt: skip


class Printer(Observer):
    """Shows what a program prints."""

    def __init__(self, put: Callable[[str], None]) -> None:
        self._put = put

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, Printed):
            self._put(event.text)


def reported(source: Source) -> bool:
    """True if a program has no errors; its mistakes are shown."""
    from handeye.systems.sigma.mal.check import checked

    found = checked(source)[1]
    show(found, source, json=False)
    return not has_errors(found)


def words(word: str | None = None, /) -> int:
    """Explain a word of MAL; without one, list all.

    Parameters
    ----------
    word
        Such as MOVE, TAKE or BEAM.
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
            f"{quoted(word)} is no word of MAL"
            + (f"; {near}" if near else "; `handeye sigma words` lists them")
        )
    say(text)
    return 0


_COMMANDS: Final = (run, words)
for _command in _COMMANDS:
    sigma.command(_command)
