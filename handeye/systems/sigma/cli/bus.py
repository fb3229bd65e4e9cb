"""The `handeye sigma` commands that show the signals on the MICROBUS, and how often a receiver misreads them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Final

from cyclopts import App, Parameter

from handeye.cli.common import Json, Overwrite, WholeNumber, positive, put_json, say, screen
from handeye.core.errors import BadArgument
from handeye.core.files import Kind, check_place, write_over
from handeye.core.plain_text import counted
from handeye.systems.sigma.cli.studies import put_study

DRAWING: Final = Kind("SVG drawing", rb"<\?xml|<svg ", ending=".svg")
_PERCENTS: Final = (1.0, 2.0, 4.0, 5.0, 6.0, 10.0, 15.0)
_MOST_PERCENT: Final = 50.0
_LONGEST_DIAGRAM: Final = 86_400.0  # s

BusFaults = Annotated[
    list[str] | None,
    Parameter(
        name="--fault",
        negative=(),
        help="A fault of the bus, as KIND, KIND:WHERE or KIND:WHERE:VALUE; `handeye sigma bus faults` lists the "
        "kinds. This option may be repeated.",
    ),
]
AllLines = Annotated[
    bool, Parameter(negative=(), help="Show all twenty status lines, including those that do not change.")
]
Seed = Annotated[
    WholeNumber, Parameter(help="Seed of the world: it determines when each microcomputer begins to poll.")
]

bus = App(
    name="bus",
    help="The MICROBUS: show its signals and the bytes that each receiver takes, and test its faults.",
)


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class DrawingOptions:
    """Options for a drawing."""

    out: Annotated[Path | None, Parameter(name=["--out", "-o"], help="File for the drawing, .svg.")] = None
    overwrite: Overwrite = False

    def check(self) -> None:
        """Raise InvalidInput if the drawing could not be written after the run."""
        if self.out is not None:
            check_place(self.out, DRAWING, overwrite=self.overwrite)

    def write(self, drawn: str) -> None:
        """Write the drawing if it was requested."""
        if self.out is not None:
            write_over(self.out, drawn.encode(), DRAWING)


NO_DRAWING: Final = DrawingOptions()


def demo(
    *,
    late_riser: Annotated[
        bool,
        Parameter(
            negative=(), help="Let the microcomputer of Y1 become free in the middle of a command to X1."
        ),
    ] = False,
    fault: BusFaults = None,
    all_lines: AllLines = False,
    seed: Seed = 0,
    json: Json = False,
    drawing: DrawingOptions = NO_DRAWING,
) -> int:
    """Send a command and ask a question; show the signals on all lines and the bytes that each receiver takes.

    From its second byte on, the command to X1 reads like a command to Y1. If Y1 becomes free in the middle of the
    command to X1 (`--late-riser`), Y1 ignores the bytes that it still receives; with `--fault long-strobe` as well, Y1
    takes these bytes for its own command.

    Exit code 0: every byte arrived as it was sent; 1: a byte was misread; 2: bad input.
    """
    from handeye.systems.sigma.bus.demo import demonstrate, told, verdict
    from handeye.systems.sigma.bus.diagram import as_svg, as_text
    from handeye.systems.sigma.bus.faults import defect

    drawing.check()
    shown = demonstrate(
        [defect(text) for text in fault or ()], late_riser=late_riser, seed=seed, all_lines=all_lines
    )
    drawing.write(as_svg(*shown.diagrams))
    if json:
        figures = {
            "count": shown.found,
            "expected": shown.wanted,
            "log": told(shown),
            "events": sorted(shown.log, key=lambda event: event.at),
        }
        put_study("bus demo", figures, completed=shown.right, message="; ".join(verdict(shown)), seed=seed)
    else:
        for number, each in enumerate(shown.diagrams):
            if number:
                say("")
            for line in as_text(each, screen.width, ascii=_no_bars(screen.encoding)):
                say(line, whole=True)
        say("")
        for line in verdict(shown):
            say(line)
    return 0 if shown.right else 1


def run(
    file: Annotated[Path, Parameter(help="A MAL program (`.mal`).")],
    /,
    *,
    fault: BusFaults = None,
    begin: Annotated[
        float | None,
        Parameter(help="Time at which the diagram begins, in seconds since power-on. Default: 0."),
    ] = None,
    end: Annotated[
        float | None,
        Parameter(
            help="Time at which the diagram ends, in seconds since power-on. Default: the end of the run."
        ),
    ] = None,
    all_lines: AllLines = False,
    statement_us: Annotated[
        WholeNumber,
        Parameter(
            name="--statement-us", help="Microseconds that the central computer takes for a statement."
        ),
    ] = 2000,
    seed: Seed = 0,
    json: Json = False,
    drawing: DrawingOptions = NO_DRAWING,
) -> int:
    """Run a program in MAL over the simulated wires of the bus, and say how busy the bus and the computer were.

    With --out, the command draws a diagram of the run from --begin to --end. The run is not kept in a folder; to keep
    a run, use `handeye sigma run --arm wired`.

    Exit code 0: all tasks have ended; 1: the program stopped before its end; 2: bad input; 130: interrupted.
    """
    from handeye.cli.panic_button import PanicButton
    from handeye.core.source import read_source
    from handeye.execution.servo import Halted
    from handeye.systems.sigma.bus.diagram import as_svg, diagram
    from handeye.systems.sigma.bus.faults import defect
    from handeye.systems.sigma.run.over_wires import ENDED, lines, over_wires
    from handeye.systems.sigma.run.plan import LONGEST_STATEMENT_US, MalPlan

    if drawing.out is None and (begin is not None or end is not None or all_lines):
        raise BadArgument("--begin, --end and --all-lines apply only to the diagram: give --out too")
    drawing.check()
    _microseconds(begin, _LONGEST_DIAGRAM if end is None else end)
    if not 0 <= statement_us <= LONGEST_STATEMENT_US:
        raise BadArgument(f"--statement-us must be between 0 and {LONGEST_STATEMENT_US}, not {statement_us}")
    program = MalPlan(name=file.name, text=read_source(file).text).program
    defects = [defect(text) for text in fault or ()]
    with PanicButton() as panic:

        def poll() -> None:
            if panic():
                raise Halted

        try:
            found, wired, log = over_wires(program, statement_us, defects, seed, poll)
        except Halted:
            raise KeyboardInterrupt from None
    if drawing.out is not None:
        span = _microseconds(begin, wired.now / 1e6 if end is None else end)
        drawn = diagram(file.name, log, *span, wired.timing, all_lines=all_lines)
        drawing.write(as_svg(drawn))
    if json:
        stopped = None if found.completed else file.name
        message = found.message or ENDED
        put_study("bus run", found, completed=found.completed, message=message, seed=seed, stopped_at=stopped)
    else:
        for line in lines(found, log):
            say(line)
    return 0 if found.completed else 1


def _microseconds(begin: float | None, end: float) -> tuple[int, int]:
    """Return the times at which a diagram begins and ends. Raises BadArgument if a diagram cannot have these times."""
    first = begin or 0.0
    if not 0 <= first < end <= _LONGEST_DIAGRAM:
        raise BadArgument(
            "a diagram must begin at 0 s or later, and end after its beginning, within the first "
            f"{_LONGEST_DIAGRAM:g} s; the given times are {first:g} s and {end:g} s"
        )
    return round(first * 1e6), round(end * 1e6)


def errors(
    *,
    clock: Annotated[
        list[float] | None,
        Parameter(
            help="Greatest error of the clocks, in percent; may be repeated. Default: 1, 2, 4, 5, 6, 10 and 15.",
            negative=(),
        ),
    ] = None,
    commands: Annotated[
        WholeNumber, Parameter(help="Number of random commands for each clock error.")
    ] = 200_000,
    seed: Annotated[
        WholeNumber,
        Parameter(
            help="Seed of the random world: the bytes of the commands, the errors of the clocks, and the times at "
            "which receivers become free."
        ),
    ] = 0,
    json: Json = False,
) -> int:
    """Send random commands to receivers that become free at random moments, and count the misread bytes.

    Exit code 0: counted; 2: bad input.
    """
    from handeye.systems.sigma.bus.statistics import error_rate

    positive(commands, "command")
    percents = tuple(clock) if clock else _PERCENTS
    for percent in percents:
        if not 0 <= percent <= _MOST_PERCENT:
            raise BadArgument(
                f"the error of the clocks must be between 0 and {_MOST_PERCENT:g} percent, not {percent:g}"
            )
    rates = [error_rate(percent / 100, commands, seed) for percent in percents]
    if json:
        misread = counted(sum(rate.misread for rate in rates), "command")
        put_study("bus errors", {"rates": rates}, completed=True, message=f"{misread} misread", seed=seed)
        return 0
    say(
        f"{counted(commands, 'command')} for each clock error; the receiver becomes free either before a command "
        "begins or in the middle of it"
    )
    say("clocks within   taken whole   too late   misread   least fast   least slow")
    for percent, rate in zip(percents, rates, strict=True):
        least = "".join(
            "         none" if each is None else f"{each:13.2%}" for each in (rate.fast, rate.slow)
        )
        say(f"{percent:>11g} %   {rate.whole:>11}   {rate.missed:>8}   {rate.misread:>7}{least}", whole=True)
    return 0


def faults(*, json: Json = False) -> int:
    """List the faults that the bus can have.

    Exit code 0: listed.
    """
    from handeye.systems.sigma.bus.faults import KINDS

    if json:
        put_json(dict(KINDS))
        return 0
    for name, kind in KINDS.items():
        form = ":".join([name, *(field.upper() for field in (kind.where, kind.value) if field)])
        usual = f" ({kind.amount} by default)" if kind.value else ""
        say(f"{form:<34} {kind.help}{usual}", whole=True)
    return 0


def self_test(
    *,
    fault: BusFaults = None,
    line: Annotated[
        bool,
        Parameter(
            negative=(),
            help="Test the bus of an assembly line, with two robots, a feeder and a remover on three segments.",
        ),
    ] = False,
    seed: Seed = 0,
    json: Json = False,
) -> int:
    """Run the power-on self-tests of the computer, the segments, each microcomputer, and the status lines.

    Exit code 0: all tests passed; 1: a test failed; 2: bad input.
    """
    from handeye.systems.sigma.bus.faults import defect
    from handeye.systems.sigma.bus.layout import LINE, SUPERSIGMA
    from handeye.systems.sigma.bus.wired import WiredBus
    from handeye.systems.sigma.diagnosis.power_on import power_on, told

    layout = LINE if line else SUPERSIGMA
    wired = WiredBus(layout, defects=[defect(text) for text in fault or ()], seed=seed)
    found = power_on(wired, layout)
    well = not any(each.fault for each in found)
    if json:
        put_study("bus test", {"tests": found}, completed=well, message="; ".join(told(found)), seed=seed)
    else:
        for sentence in told(found):
            say(sentence)
    return 0 if well else 1


def _no_bars(encoding: str) -> bool:
    """Return True if a terminal cannot show the bars of a diagram."""
    try:
        "▔▁│µ".encode(encoding or "ascii")
    except (UnicodeEncodeError, LookupError):
        return True
    return False


for _command in (demo, run, errors, faults):
    bus.command(_command)
bus.command(self_test, name="test")
