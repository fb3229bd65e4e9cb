"""Demonstrates the protocol with a command that all free microcomputers receive, and with a question and its
answer."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

from handeye.ports.microbus import BusFault, Command
from handeye.systems.sigma.bus.diagram import Diagram, diagram
from handeye.systems.sigma.bus.events import AnyBusEvent, FrameTaken
from handeye.systems.sigma.bus.faults import BusDefect
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.bus.words import command_text, event_text, spaced
from handeye.systems.sigma.firmware.device import PS
from handeye.systems.sigma.protocol import (
    ANSWERS,
    NUMBERS,
    Op,
    move,
    name_of,
    position,
    set_position,
    signed,
)

ASKED: Final = "Y1"
COUNT: Final = 0x1234  # the count that Y1 has at first
SHORT_MOVE: Final = 8  # steps that the late riser makes
COMMAND: Final = Command(number=NUMBERS["X1"], op=Op.MOVE, detail=Op.SET_POSITION, value=0x0102)
"""A move of X1. From its second byte on, the command reads like a command to Y1 that would change Y1's count."""
RISES: Final = 26  # microseconds after the command began, when the late riser becomes free
_MARGIN: Final = 20  # microseconds drawn before and after the command
_ENOUGH: Final = 60_000_000  # microseconds


@dataclass(kw_only=True)
class Demonstration:
    """The log and the results of a demonstration."""

    bus: WiredBus
    log: list[AnyBusEvent] = field(default_factory=list)
    diagrams: list[Diagram] = field(default_factory=list)
    command: bytes = b""
    misread: list[FrameTaken] = field(default_factory=list)  # frames that differ from what was sent
    strangers: list[FrameTaken] = field(default_factory=list)  # frames on which a wrong microcomputer acted
    deaf: bool = False  # True: the microcomputer to which the command is addressed does not act
    wanted: int = COUNT  # the count that the question should find
    found: int | None = None
    failed: str = ""  # why the question had no answer

    @property
    def right(self) -> bool:
        """True if all bytes arrived as they were sent."""
        return not (self.misread or self.deaf or self.strangers) and self.found == self.wanted


def demonstrate(
    defects: Sequence[BusDefect] = (), *, late_riser: bool = False, seed: int = 0, all_lines: bool = False
) -> Demonstration:
    """Send a command and ask a question. If `late_riser` is True, the microcomputer of Y1 becomes free in the middle
    of the command.
    """
    shown = Demonstration(bus=WiredBus(defects=defects, seed=seed))
    bus, number = shown.bus, NUMBERS[ASKED]
    bus.tell.append(shown.log.append)
    bus.send(set_position(ASKED, COUNT))
    _pass(bus, bus.now + bus.timing.command)
    if late_riser:
        bus.send(move(ASKED, SHORT_MOVE))
        shown.wanted += SHORT_MOVE
        due = bus.motor(number).due
        if due is not None:
            _pass(bus, due // PS - RISES)
    begun, shown.command = bus.now, COMMAND.frame
    bus.send(COMMAND)
    _pass(bus, bus.now + _MARGIN)
    title = f"{spaced(COMMAND.frame)}: {command_text(COMMAND)}"
    if late_riser:
        title += f"; {ASKED} becomes free {RISES} µs later"
    shown.diagrams.append(_drawn(shown, title, begun, all_lines=all_lines))
    _pass(bus, bus.now + 2 * bus.timing.command)
    begun = bus.now
    try:
        shown.found = signed(bus.ask(position(ASKED), ANSWERS[Op.POSITION]))
    except BusFault as fault:
        shown.failed = str(fault)
    title = f"{spaced(position(ASKED).frame)}: where is {ASKED}?"
    shown.diagrams.append(_drawn(shown, title, begun, all_lines=all_lines))
    bus.wait_free(NUMBERS["X1"], _ENOUGH)
    sent = {COMMAND.frame, *(each.frame for each in (position(ASKED), set_position(ASKED, COUNT)))}
    sent.add(move(ASKED, SHORT_MOVE).frame)
    taken = [event for event in shown.log if isinstance(event, FrameTaken)]
    shown.misread = [event for event in taken if event.frame not in sent]
    shown.strangers = [e for e in taken if e.own and e.frame in sent and e.frame[0] != e.number]
    shown.deaf = not any(e.own and (e.number, e.frame) == (COMMAND.number, COMMAND.frame) for e in taken)
    return shown


def _drawn(shown: Demonstration, title: str, begun: int, *, all_lines: bool) -> Diagram:
    end = min(shown.bus.now, begun + 5 * shown.bus.timing.command)
    return diagram(title, shown.log, begun, end, shown.bus.timing, all_lines=all_lines)


def _pass(bus: WiredBus, until: int) -> None:
    while bus.now < until:
        bus.wait(until)


def verdict(shown: Demonstration) -> list[str]:
    """Describe the results of a demonstration in sentences."""
    out = []
    for event in shown.misread:
        acts = f", and acts: {command_text(Command.of(event.frame))}" if event.own else ", and drops it"
        out.append(f"{name_of(event.number)} takes {spaced(event.frame)}, which was never sent{acts}")
    for event in shown.strangers:
        out.append(
            f"{name_of(event.number)} acts on {spaced(event.frame)}, which was sent to {name_of(event.frame[0])}"
        )
    if shown.deaf:
        out.append(
            f"{name_of(COMMAND.number)} does not act on {spaced(COMMAND.frame)}, which was sent to "
            f"{name_of(COMMAND.number)}"
        )
    if shown.failed:
        out.append(shown.failed)
    elif shown.found != shown.wanted:
        out.append(f"{ASKED} answers with the count {shown.found} instead of {shown.wanted}")
    return out or [
        f"every byte arrived as it was sent; the count of {ASKED} is {shown.found}, as it should be"
    ]


def told(shown: Demonstration) -> list[str]:
    """Return the log of the command and of the question, one line per event."""
    first = shown.diagrams[0].begin
    events = sorted((e for e in shown.log if e.at >= first), key=lambda event: event.at)
    return [event_text(event) for event in events]
