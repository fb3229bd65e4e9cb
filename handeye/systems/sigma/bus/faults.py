"""Defines the faults that can be injected into a bus, each with its name."""

from collections.abc import Container
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.record import Record
from handeye.systems.sigma.protocol import number_of


class BusDefect(Record, frozen=True, kw_only=True):
    """An injected fault: its kind, the segment or microcomputer that has it, and its size."""

    kind: str
    where: int = 0
    value: int = 0


class Defects(Record, frozen=True, kw_only=True):
    """A kind of fault: its meaning, where it can occur, and its possible sizes."""

    help: str
    where: str = ""  # `segment` or `microcomputer`; empty: the whole bus
    default: int = 0  # place
    value: str = ""  # meaning of the number of the fault; empty: it has no number
    amount: int = 0  # the number if none is given
    least: int = 0
    most: int = 1


KINDS: Final[dict[str, Defects]] = {
    "stuck-low": Defects(help="a data line always reads 0", where="segment", value="bit", amount=5, most=7),
    "stuck-high": Defects(help="a data line always reads 1", where="segment", value="bit", amount=3, most=7),
    "dead-interface": Defects(help="no signal passes into or out of a segment", where="segment"),
    "no-turn": Defects(
        help="a regenerator does not reverse its direction for answers", where="segment", default=1
    ),
    "long-strobe": Defects(
        help="the computer raises /DATA READY too late: this many microseconds after the command begins",
        value="microseconds",
        amount=35,
        least=3,
        most=99,
    ),
    "slow-lines": Defects(
        help="a data line shows each new level this many microseconds too late",
        value="microseconds",
        amount=6,
        most=19,
    ),
    "dead": Defects(help="a microcomputer does nothing", where="microcomputer"),
    "clock": Defects(
        help="the clock of a microcomputer is slow by this fraction; a negative value makes it fast",
        where="microcomputer",
        value="permille",
        amount=200,
        least=-500,
        most=500,
    ),
    "address": Defects(
        help="a microcomputer answers to this number instead of its own",
        where="microcomputer",
        value="number",
        amount=1,
        most=255,
    ),
    "status-a": Defects(
        help="status line A is stuck at this level", where="microcomputer", value="level", amount=1
    ),
    "status-b": Defects(
        help="status line B is stuck at this level", where="microcomputer", value="level", amount=1
    ),
    "no-reflex": Defects(help="the wires from the wrists to the motors are cut"),
    "no-interrupt": Defects(help="the wire that joins the A lines of the motors is broken"),
}
"""Kinds of faults by name, as `--fault` takes them."""


def defect(text: str) -> BusDefect:
    """Parse a fault: `KIND`, `KIND:WHERE` or `KIND:WHERE:VALUE`. Raises BadArgument if the text is not a fault of the
    bus.

    A kind that concerns the whole bus has no WHERE.
    """
    name, *rest = text.split(":")
    if name not in KINDS:
        raise NoSuchName(f"there is no bus fault {quoted(name)}; the bus faults are {', '.join(KINDS)}")
    kind = KINDS[name]
    fields = [*([kind.where] if kind.where else []), *([kind.value] if kind.value else [])]
    if len(rest) > len(fields):
        form = ":".join([name, *(field.upper() for field in fields)])
        raise BadArgument(f"{quoted(text)} has too many fields for this fault: write {form}")
    where, value = kind.default, kind.amount
    if kind.where and rest:
        given = rest.pop(0)
        if kind.where == "microcomputer" and not given.isdigit():
            where = number_of(given)
        else:
            where = _number(given, kind.where, 0, 255)
    if rest:
        value = _number(rest[0], kind.value, kind.least, kind.most)
    return BusDefect(kind=name, where=where, value=value)


def _number(text: str, what: str, least: int, most: int) -> int:
    try:
        number = int(text)
    except ValueError:
        raise BadArgument(f"the {what} of a fault must be a whole number, not {quoted(text)}") from None
    if not least <= number <= most:
        raise BadArgument(f"the {what} of a fault must be between {least} and {most}, not {number}")
    return number


def check_place(defect: BusDefect, segments: int, numbers: Container[int]) -> None:
    """Raise BadArgument if the bus does not have the segment or microcomputer that a fault names."""
    where = KINDS[defect.kind].where
    if where == "segment" and not (defect.kind == "no-turn") <= defect.where < segments:
        what = "regenerator before segment" if defect.kind == "no-turn" else "segment"
        raise BadArgument(f"there is no {what} {defect.where} on this bus")
    if where == "microcomputer" and defect.where not in numbers:
        raise BadArgument(f"there is no microcomputer {defect.where} on this bus")
