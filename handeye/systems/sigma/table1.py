"""Reproduces table 1 of the paper: how often four programs send commands, and how much they load the bus and
the computer.

Layer 1 repeats one move. The length of the move is chosen so that a command takes as long as in the paper. Layer 1
checks the arithmetic of bus and motors. Layer 2 runs programs like those named in the paper; these programs are not
fitted to the table.
"""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.core.record import Record
from handeye.core.resources import plans
from handeye.core.source import read_source
from handeye.ports.microbus import COMMAND_BYTES
from handeye.systems.sigma.machine.perfect import BYTE_US, PerfectMotors
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.virtual_machine import STATEMENT_US, VirtualMachine
from handeye.systems.sigma.protocol import STEP_MM

MOST: Final = 1_000_000 // (COMMAND_BYTES * BYTE_US)  # commands that the bus can carry per second
BUSIEST: Final = 0.005  # fraction of the bus that no real program exceeds
LEAST_IDLE: Final = 0.5  # least fraction of the time in which the computer has nothing to do
TIMES_FASTER: Final = (1.2, 2.0)  # speed of two arms that share a job, as a multiple of that of one arm
WITHIN: Final = 0.01  # greatest relative error of the times of layer 1
CALCULATIONS: Final = (0, 10, 100, 1000)  # numbers of calculations between two moves


class PaperRow(Record, frozen=True, kw_only=True):
    """A row of the printed table, and the length (steps) of the move with which layer 1 reproduces this row."""

    name: str
    job: str
    arms: int
    commands: int
    seconds: float
    per_second: float
    saturation: float  # percent
    steps: int


ROWS: Final = (
    PaperRow(
        name="ORD", job="a program that puts pieces in order", arms=1, commands=751, seconds=167, per_second=4.5,
        saturation=0.045, steps=915,
    ),
    PaperRow(
        name="SCP1B", job="pick and place with one arm", arms=1, commands=328, seconds=56, per_second=5.86,
        saturation=0.059, steps=579,
    ),
    PaperRow(
        name="SCP2B", job="pick and place with two arms", arms=2, commands=394, seconds=36, per_second=10.94,
        saturation=0.109, steps=651,
    ),
    PaperRow(
        name="PRCO", job="assembly of a pump with two arms", arms=2, commands=1600, seconds=260, per_second=6.15,
        saturation=0.062, steps=1804,
    ),
)  # fmt: skip


class Load(Record, frozen=True, kw_only=True):
    """How much a program loads the bus and the computer."""

    name: str
    commands: int  # number of commands, including questions
    seconds: float
    per_second: float
    saturation: float  # percent of the commands that the bus carries
    idle: float  # percent of the time in which the computer has nothing to do


class Claim(Record, frozen=True, kw_only=True):
    """A statement of the paper, and whether it is true for this simulation."""

    claim: str
    holds: bool
    found: str


class Table1(Record, frozen=True, kw_only=True):
    """The rows of the paper's table, and the paper's claims. Also the simulated loads: of layer 1, of layer 2, and of
    programs that calculate.
    """

    paper: tuple[PaperRow, ...]
    layer1: tuple[Load, ...]
    layer2: tuple[Load, ...]
    arithmetic: tuple[Load, ...]
    claims: tuple[Claim, ...]

    @property
    def holds(self) -> bool:
        """True if all claims hold."""
        return all(each.holds for each in self.claims)


def uniform(arms: int, moves: int, steps: int) -> str:
    """Return a program in which each arm repeats one move, back and forth."""
    each = moves // arms
    tasks = [_back_and_forth(10 * arm, arm, each, steps) for arm in range(1, arms + 1)]
    return tasks[0] if arms == 1 else f"5 START OTHER\n{tasks[0]}19 TASK OTHER\n{tasks[1]}"


def _back_and_forth(first: int, arm: int, moves: int, steps: int) -> str:
    way, count = f"WAY{arm}", f"N{arm}"
    lines = (
        f"{way} = {steps * STEP_MM:.10g}",
        f"FOR {count} = 1 TO {moves}",
        f"MOVE X{arm} BY {way}",
        f"{way} = - {way}",
        f"NEXT {count}",
    )
    return "".join(f"{first + number} {line}\n" for number, line in enumerate(lines))


def calculating(calculations: int, moves: int = 20) -> str:
    """Return a program with `calculations` additions before each move. A line has at most 100 additions."""
    whole, rest = divmod(calculations, 100)
    sums = [f"A = 1{' + 1' * count}" for count in [100] * whole + [rest] * bool(rest)]
    lines = ["WAY = 24", f"FOR N = 1 TO {moves}", *sums, "MOVE X1 BY WAY", "WAY = - WAY", "NEXT N"]
    return "".join(f"{number} {line}\n" for number, line in enumerate(lines, 1))


def load(name: str, text: str, statement_us: int = STATEMENT_US) -> Load:
    """Run a program on perfect motors, and measure how much the program loads the bus and the computer."""
    motors = PerfectMotors()
    vm = VirtualMachine(program_of(f"{name}.mal", text), motors, statement_us=statement_us)
    vm.begin()
    while vm.turn:
        vm.statement()
        vm.settle()
    assert vm.memory.fault is None, vm.memory.fault
    rate = vm.memory.commands / vm.time
    return Load(
        name=name,
        commands=vm.memory.commands,
        seconds=vm.time,
        per_second=rate,
        saturation=100 * rate / MOST,
        idle=100 * vm.idle,
    )


def real(name: str) -> str:
    """Return the text of a program of layer 2."""
    return read_source(plans() / f"table1_{name.lower()}.mal").text


def table1() -> Table1:
    """Measure both layers."""
    layer1 = tuple(load(row.name, uniform(row.arms, row.commands, row.steps), 0) for row in ROWS)
    layer2 = tuple(load(row.name, real(row.name)) for row in ROWS)
    arithmetic = tuple(load(f"{count}", calculating(count)) for count in CALCULATIONS)
    return Table1(
        paper=ROWS, layer1=layer1, layer2=layer2, arithmetic=arithmetic,
        claims=tuple(_claims(layer1, layer2, arithmetic)),
    )  # fmt: skip


def _claims(layer1: Sequence[Load], layer2: Sequence[Load], arithmetic: Sequence[Load]) -> Iterator[Claim]:
    exact = sum(found.commands == row.commands for row, found in zip(ROWS, layer1, strict=True))
    yield Claim(
        claim="layer 1: the numbers of commands are the same as in the paper",
        holds=exact == len(ROWS),
        found=f"{exact} of {len(ROWS)} programs",
    )
    worst = max(abs(found.seconds / row.seconds - 1) for row, found in zip(ROWS, layer1, strict=True))
    yield Claim(
        claim=f"layer 1: the times are within {WITHIN:.0%} of those in the paper",
        holds=worst <= WITHIN,
        found=f"at most {worst:.2%} off",
    )
    digits = max(abs(found.saturation - row.saturation) for row, found in zip(ROWS, layer1, strict=True))
    yield Claim(
        claim="layer 1: the saturation is the same as in the paper, within one unit of the last printed digit",
        holds=digits < 0.001,
        found=f"at most {digits:.4f} % off",
    )
    busiest = max(layer2, key=lambda each: each.saturation)
    yield Claim(
        claim=f"layer 2: no program uses more than {BUSIEST:.1%} of what the bus can carry (in the paper, at most "
        "0.109 %)",
        holds=busiest.saturation < 100 * BUSIEST,
        found=f"at most {busiest.saturation:.3f} %, by {busiest.name}",
    )
    ord_, one, two, prco = layer2
    faster = one.seconds / two.seconds
    yield Claim(
        claim=f"layer 2: two arms are {TIMES_FASTER[0]:g} to {TIMES_FASTER[1]:g} times as fast as one",
        holds=TIMES_FASTER[0] <= faster <= TIMES_FASTER[1],
        found=f"{faster:.2f} times",
    )
    yield Claim(
        claim="layer 2: of the four programs, SCP2B sends the most commands per second",
        holds=two.per_second > max(ord_.per_second, one.per_second, prco.per_second),
        found=f"{two.per_second:.2f} a second",
    )
    busy = min(layer2, key=lambda each: each.idle)
    yield Claim(
        claim=f"layer 2: the computer is idle for at least {LEAST_IDLE:.0%} of the time",
        holds=busy.idle >= 100 * LEAST_IDLE,
        found=f"at least {busy.idle:.1f} %, in {busy.name}",
    )
    idle = [each.idle for each in arithmetic]
    yield Claim(
        claim="arithmetic, not the bus, saturates the computer",
        holds=idle == sorted(idle, reverse=True) and idle[-1] < 100 * (1 - LEAST_IDLE),
        found=f"with {CALCULATIONS[-1]} calculations per move, the computer is idle for {idle[-1]:.1f} % of the time",
    )


def lines(found: Table1) -> Iterator[str]:
    """Yield the results of both layers as text."""
    form = "{:6} {:>9} {:>9} {:>8} {:>12} {:>8}"
    for title, layer in (
        ("layer 1: one move, repeated", found.layer1),
        ("layer 2: real programs", found.layer2),
    ):
        yield title
        yield form.format("", "commands", "seconds", "com/s", "saturation", "idle")
        for row, each in zip(found.paper, layer, strict=True):
            yield _texts(form, row.name, each)
            paper = f"{row.seconds:g}", f"{row.per_second:.2f}", f"{row.saturation:.3f} %"
            yield form.format(" paper", row.commands, *paper, "").rstrip()
        yield ""
    yield "calculations before each move"
    yield from (_texts(form, each.name, each) for each in found.arithmetic)
    yield ""
    for claim in found.claims:
        yield f"{'holds' if claim.holds else 'FAILS'}: {claim.claim}: {claim.found}"


def _texts(form: str, name: str, each: Load) -> str:
    seconds, rate = f"{each.seconds:.1f}", f"{each.per_second:.2f}"
    return form.format(name, each.commands, seconds, rate, f"{each.saturation:.3f} %", f"{each.idle:.1f} %")


def page_tables(found: Table1) -> str:
    """Return the tables of the documentation page, in Markdown."""
    out = []
    for title, layer in (
        ("Layer 1: one move, repeated", found.layer1),
        ("Layer 2: real programs", found.layer2),
    ):
        out += [
            f"## {title}\n",
            "| program | | commands | seconds | commands/s | saturation of the bus | computer idle |",
            "|---|---|---|---|---|---|---|",
        ]
        for row, each in zip(found.paper, layer, strict=True):
            out.append(
                f"| {row.name} | paper | {row.commands} | {row.seconds:g} | {row.per_second:.2f} "
                f"| {row.saturation:.3f} % | |"
            )
            out.append(
                f"| | handeye | {each.commands} | {each.seconds:.1f} | {each.per_second:.2f} "
                f"| {each.saturation:.3f} % | {each.idle:.1f} % |"
            )
        out.append("")
    out += [
        "## Arithmetic\n",
        "A program on one arm moves X1 back and forth, and calculates before each move.\n",
        "| calculations before each move | commands/s | saturation of the bus | computer idle |",
        "|---|---|---|---|",
    ]
    out += [
        f"| {each.name} | {each.per_second:.2f} | {each.saturation:.3f} % | {each.idle:.1f} % |"
        for each in found.arithmetic
    ]
    out += ["", "## Claims\n", "| claim | | found |", "|---|---|---|"]
    out += [
        f"| {each.claim} | {'holds' if each.holds else 'fails'} | {each.found} |" for each in found.claims
    ]
    return "\n".join(out) + "\n"
