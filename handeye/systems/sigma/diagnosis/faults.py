"""Twenty faults that can be planted, each with the part that has it. A seed determines the place and the kind
of a fault."""

from collections.abc import Callable, Iterator, Sequence
from typing import Final, Literal, NamedTuple, TypeVar

import numpy as np

from handeye.core.diagnostics import quoted
from handeye.core.distributions import random_numbers
from handeye.core.errors import NoSuchName
from handeye.core.record import Record
from handeye.systems.sigma.bus.faults import BusDefect
from handeye.systems.sigma.bus.layout import SUPERSIGMA, Layout, Place
from handeye.systems.sigma.protocol import AXES, COMPONENTS, NUMBERS

MachineKind = Literal[
    "pulses", "phase", "switch", "gauge", "accelerometer", "multiplexer", "converter", "beam", "lamp", "fingers",
    "supply",
]  # fmt: skip
FEEDER: Final = (10, 11, 12, 13)
BENCH: Final = Layout(
    places=(*SUPERSIGMA.places, *(Place(number=number, kind="motor", segment=1) for number in FEEDER)),
    behind=(-1, 0),
)
"""SUPERSIGMA, and a feeder of four motors behind a regenerator."""
OFFSET_N: Final = 1.5  # N: offset of a faulty gauge
ARMS: Final = (1, 2)
Option = TypeVar("Option")
_NAMES: Final = (*NUMBERS,)


class MachineFault(Record, frozen=True, kw_only=True):
    """A fault of the machine, not of the bus."""

    kind: MachineKind
    number: int = 0  # number of the microcomputer to which the faulty part is connected
    which: int = 0  # component of a wrist, bit of a converter, or switch: 0 is the low one
    level: int = 0  # 1: the part is stuck on, or has an offset


class Planted(Record, frozen=True, kw_only=True):
    """A planted fault, and the part that has it."""

    fault: str
    part: str
    told: str
    bus: tuple[BusDefect, ...] = ()
    machine: tuple[MachineFault, ...] = ()


class Draw:
    """Chooses the place and the kind of a fault. With a seed, the choice is random; without a seed, the first option
    is always chosen.
    """

    def __init__(self, rng: np.random.Generator | None) -> None:
        self._rng = rng

    def one(self, options: Sequence[Option]) -> Option:
        """Choose one of these options."""
        return options[0] if self._rng is None else options[int(self._rng.integers(len(options)))]


class _InTurn(Draw):
    """Chooses the options whose numbers are given in advance. When the numbers are used up, it always chooses the
    first option.
    """

    def __init__(self, numbers: Sequence[int]) -> None:
        super().__init__(None)
        self._left = [*numbers]
        self.numbers, self.sizes, self.words = list[int](), list[int](), list[str]()

    def one(self, options: Sequence[Option]) -> Option:
        number = self._left.pop(0) if self._left else 0
        self.numbers.append(number)
        self.sizes.append(len(options))
        self.words.append(str(options[number]))
        return options[number]


class Fault(NamedTuple):
    """A kind of fault that can be planted."""

    help: str
    plant: Callable[[str, Draw], Planted]


def _bus(kind: str, part: str, told: str, where: int = 0, value: int = 0) -> Callable[[str], Planted]:
    defect = BusDefect(kind=kind, where=where, value=value)
    return lambda name: Planted(fault=name, part=part, told=told, bus=(defect,))


def _bit(name: str, draw: Draw) -> Planted:
    level, segment, bit = draw.one(("high", "low")), draw.one((0, 1)), draw.one((3, 0, 1, 2, 4, 5, 6, 7))
    told = f"data line {bit} of segment {segment} is stuck {level}"
    return _bus(f"stuck-{level}", f"segment {segment}", told, segment, bit)(name)


def _interface(name: str, draw: Draw) -> Planted:
    segment = draw.one((1, 0))
    told = f"the interface of segment {segment} is dead"
    return _bus("dead-interface", f"segment {segment}", told, segment)(name)


def _regenerator(name: str, _: Draw) -> Planted:
    return _bus("no-turn", "regenerator 1", "regenerator 1 does not reverse its direction for answers", 1)(
        name
    )


def _strobe(name: str, draw: Draw) -> Planted:
    rises = draw.one((35, 28, 32, 45))
    told = f"the computer raises /DATA READY {rises} microseconds after the command begins"
    return _bus("long-strobe", "computer", told, 0, rises)(name)


def _dead(name: str, draw: Draw) -> Planted:
    who = draw.one(_NAMES)
    return _bus("dead", f"microcomputer {who}", f"the microcomputer {who} is dead", NUMBERS[who])(name)


def _clock(name: str, draw: Draw) -> Planted:
    who, permille = draw.one(_NAMES), draw.one((150, 60, 90, 200, -60, -150))
    told = f"the clock of {who} is {'slow' if permille > 0 else 'fast'} by {abs(permille) / 10:g} %"
    return _bus("clock", f"microcomputer {who}", told, NUMBERS[who], permille)(name)


def _address(name: str, draw: Draw) -> Planted:
    who = draw.one(_NAMES)
    other = draw.one([number for number in (1, 0, 7, 12, 40) if number != NUMBERS[who]])
    told = f"the microcomputer {who} answers to the number {other} instead of its own"
    return _bus("address", f"microcomputer {who}", told, NUMBERS[who], other)(name)


def _status(name: str, draw: Draw) -> Planted:
    who, line, level = draw.one(_NAMES), draw.one("AB"), draw.one(("high", "low"))
    told = f"status line {line} of {who} is stuck {level}"
    part, stuck = f"status line {line} of {who}", int(level == "high")
    return _bus(f"status-{line.lower()}", part, told, NUMBERS[who], stuck)(name)


def _interrupt(name: str, _: Draw) -> Planted:
    return _bus("no-interrupt", "interrupt wire", "the wire that joins the A lines is broken")(name)


def _machine(
    name: str, part: str, told: str, kind: MachineKind, who: str = "", which: int = 0, level: int = 0
) -> Planted:
    fault = MachineFault(kind=kind, number=NUMBERS.get(who, 0), which=which, level=level)
    return Planted(fault=name, part=part, told=told, machine=(fault,))


def _pulses(name: str, draw: Draw) -> Planted:
    who, every = draw.one(AXES), draw.one((20, 10, 50))
    told = f"the microcomputer {who} leaves out every {every}th pulse"
    return _machine(name, f"microcomputer {who}", told, "pulses", who, every)


def _phase(name: str, draw: Draw) -> Planted:
    who = draw.one(AXES)
    return _machine(name, f"driver of {who}", f"one phase of the driver of {who} is dead", "phase", who)


def _switch(name: str, draw: Draw) -> Planted:
    who, end, level = draw.one(AXES), draw.one(("low", "high")), draw.one(("off", "on"))
    told = f"the {end} switch of {who} is stuck {level}"
    return _machine(
        name, f"{end} switch of {who}", told, "switch", who, ("low", "high").index(end), int(level == "on")
    )


def _wrist(draw: Draw) -> tuple[int, int]:
    return draw.one(ARMS), COMPONENTS.index(draw.one(COMPONENTS))


def _gauge(name: str, draw: Draw) -> Planted:
    (arm, which), level = _wrist(draw), draw.one(("dead", "offset"))
    part = f"gauge {COMPONENTS[which]} of wrist {arm}"
    told = f"the {part} {'is dead' if level == 'dead' else f'reads {OFFSET_N:g} N too much'}"
    return _machine(name, part, told, "gauge", f"FORCE{arm}", which, int(level == "offset"))


def _accelerometer(name: str, draw: Draw) -> Planted:
    arm, which = _wrist(draw)
    part = f"accelerometer {COMPONENTS[which]} of wrist {arm}"
    return _machine(name, part, f"the {part} is dead", "accelerometer", f"FORCE{arm}", which)


def _multiplexer(name: str, draw: Draw) -> Planted:
    arm, which = _wrist(draw)
    told = f"the multiplexer of wrist {arm} is stuck at {COMPONENTS[which]}"
    return _machine(name, f"multiplexer of wrist {arm}", told, "multiplexer", f"FORCE{arm}", which)


def _converter(name: str, draw: Draw) -> Planted:
    arm, bit, level = draw.one(ARMS), draw.one((5, 0, 1, 2, 3, 4, 6, 7, 8, 9)), draw.one((0, 1))
    told = f"bit {bit} of the converter of wrist {arm} is always {level}"
    return _machine(name, f"converter of wrist {arm}", told, "converter", f"FORCE{arm}", bit, level)


def _beam(name: str, draw: Draw) -> Planted:
    arm, level = draw.one(ARMS), draw.one(("cut", "free"))
    told = f"the beam of hand {arm} always reads {level}"
    return _machine(name, f"beam of hand {arm}", told, "beam", f"HAND{arm}", 0, int(level == "cut"))


def _lamp(name: str, draw: Draw) -> Planted:
    arm = draw.one(ARMS)
    return _machine(name, f"lamp of hand {arm}", f"the lamp of hand {arm} is dim", "lamp", f"HAND{arm}")


def _fingers(name: str, draw: Draw) -> Planted:
    arm = draw.one(ARMS)
    told = f"the fingers of hand {arm} take .4 s to close"
    return _machine(name, f"fingers of hand {arm}", told, "fingers", f"HAND{arm}")


def _supply(name: str, _: Draw) -> Planted:
    return _machine(name, "supply", "the supply sags while three motors or more move", "supply")


FAULTS: Final[dict[str, Fault]] = {
    "bit": Fault("a data line of a segment is stuck", _bit),
    "interface": Fault("the interface of a segment is dead", _interface),
    "regenerator": Fault("a regenerator does not reverse its direction for answers", _regenerator),
    "strobe": Fault("the computer raises its strobe too late", _strobe),
    "dead": Fault("a microcomputer is dead", _dead),
    "clock": Fault("the clock of a microcomputer is wrong", _clock),
    "address": Fault("a microcomputer answers to a wrong number", _address),
    "status": Fault("a status line is stuck", _status),
    "interrupt": Fault("the wire that joins the A lines is broken", _interrupt),
    "pulses": Fault("a microcomputer leaves out pulses", _pulses),
    "phase": Fault("one phase of a motor's driver is dead", _phase),
    "switch": Fault("a switch at the end of a rail is stuck", _switch),
    "gauge": Fault("a strain gauge of a wrist is dead, or has an offset", _gauge),
    "accelerometer": Fault("an accelerometer of a wrist is dead", _accelerometer),
    "multiplexer": Fault("the multiplexer of a wrist is stuck", _multiplexer),
    "converter": Fault("a bit of a wrist's converter is stuck", _converter),
    "beam": Fault("a light beam is stuck", _beam),
    "lamp": Fault("the lamp of a light beam is dim", _lamp),
    "fingers": Fault("the fingers of a hand are slow", _fingers),
    "supply": Fault("the supply of the motors sags", _supply),
}
"""The kinds of faults by name, as `--fault` takes them."""


def planted(name: str, seed: int | None = None) -> Planted:
    """Return the fault called `name`, at its usual place, or at a random one if a seed is given. Raises NoSuchName if
    no fault has this name.
    """
    if name not in FAULTS:
        raise NoSuchName(f"there is no fault {quoted(name)}; the faults are {', '.join(FAULTS)}")
    rng = None if seed is None else random_numbers(seed, f"diagnosis {name}")
    return FAULTS[name].plant(name, Draw(rng))


def variants(name: str) -> Iterator[tuple[str, Planted]]:
    """Yield all variants of the fault called `name`, one for each place and kind. With each variant, yield a text that
    names the variant, such as `dead.X1`. The usual variant comes first.
    """
    numbers: list[int] | None = []
    while numbers is not None:
        draw = _InTurn(numbers)
        found = FAULTS[name].plant(name, draw)
        yield ".".join([name, *draw.words]), found
        last = [n for n, size in enumerate(draw.sizes) if draw.numbers[n] + 1 < size]
        numbers = [*draw.numbers[: last[-1]], draw.numbers[last[-1]] + 1] if last else None


def drawn(seed: int) -> Planted:
    """Return the fault of the game with this seed."""
    names = [*FAULTS]
    return planted(names[int(random_numbers(seed, "diagnosis").integers(len(names)))], seed)
