"""Describes commands and events of the bus in words."""

from handeye.core.plain_text import counted
from handeye.ports.microbus import Command, Status
from handeye.systems.sigma.bus.events import (
    AnswerEnded,
    AnyBusEvent,
    ByteHeard,
    ByteSpoken,
    CommandSent,
    FrameTaken,
    InterruptLine,
    StatusLines,
)
from handeye.systems.sigma.firmware.device import PS
from handeye.systems.sigma.protocol import SLOW_STEP_MM, Op, name_of


def spaced(frame: bytes) -> str:
    """Return bytes in hexadecimal, such as `00 01 03 20`."""
    return frame.hex(" ").upper()


def command_text(command: Command) -> str:
    """Describe a command in words, for example `MOVE X1 by -800 steps, curve 3`."""
    name, code = name_of(command.number), command.detail >> 1
    if command.op not in (*Op,):
        return f"operation {command.op:02X} to {name}, an operation that no microcomputer has"
    op = Op(command.op)
    way = "-" if command.detail & 1 else ""
    by = f"{way}{counted(command.value, 'step')}"
    match op:
        case Op.MOVE:
            return f"MOVE {name} by {by}, curve {code & 0b111}"
        case Op.MOVE_SLOW:
            return f"MOVE {name} by {by} at {code * SLOW_STEP_MM} mm/s"
        case Op.LIMIT_SPEED | Op.SET_POSITION:
            return f"{op.name} {name} {command.value}"
        case Op.THRESHOLD | Op.ACTUATE:
            return f"{op.name} {name} {command.detail} to {command.value}"
        case Op.FORCE:
            return f"{op.name} {name} {command.detail}"
        case _:
            return f"{op.name} {name}"


def event_text(event: AnyBusEvent) -> str:
    """Return an event as a line of text, which begins with the time in microseconds."""
    return f"{event.at / PS:12.2f}  {_what(event)}"


def _what(event: AnyBusEvent) -> str:
    match event:
        case CommandSent():
            return f"the computer sends {spaced(event.frame)}: {command_text(Command.of(event.frame))}"
        case FrameTaken(own=True):
            command = command_text(Command.of(event.frame))
            return f"{name_of(event.number)} takes {spaced(event.frame)}, and acts: {command}"
        case FrameTaken():
            return f"{name_of(event.number)} takes {spaced(event.frame)}, and drops it"
        case ByteSpoken():
            return f"{name_of(event.number)} answers {event.byte:02X}"
        case ByteHeard():
            return f"the computer takes {event.byte:02X}"
        case AnswerEnded():
            failed = f"; {event.failed}" if event.failed else ""
            told = spaced(event.answer) or "nothing"
            return f"the wait for the answer of {name_of(event.number)} ends; received: {told}{failed}"
        case StatusLines():
            status = Status(event.status)
            return f"{name_of(event.number)} shows {event.status >> 1}-{event.status & 1}, {status.name}"
        case InterruptLine():
            return f"the interrupt goes {'high' if event.level else 'low'}"
