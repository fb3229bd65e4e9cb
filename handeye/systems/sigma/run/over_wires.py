"""Runs a MAL program on the simulated bus without gantries, to measure the load on the bus and on the central
computer.
"""

from collections.abc import Callable, Sequence
from typing import Final

from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.systems.sigma.bus.events import AnyBusEvent, CommandSent, FrameTaken
from handeye.systems.sigma.bus.faults import BusDefect
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.bus.words import spaced
from handeye.systems.sigma.mal.compiler import MalProgram
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine

_MICROSECONDS: Final = 1_000_000
_LONGEST: Final = 3_600  # s: longest run, by the clock of the machine
ENDED: Final = "all tasks have ended"


class BusRun(Record, frozen=True, kw_only=True):
    """The results of running a program on the bus."""

    completed: bool
    message: str  # why the program did not finish; empty if it did
    seconds: float
    commands: int  # number of commands, including questions
    per_second: float
    saturation: float  # fraction of the greatest number of commands that the bus can carry
    idle: float  # fraction of the time in which no statement could be executed
    misread: int  # frames that receivers took and that were never sent


def over_wires(
    program: MalProgram,
    statement_us: int,
    defects: Sequence[BusDefect] = (),
    seed: int = 0,
    poll: Callable[[], None] = lambda: None,
) -> tuple[BusRun, WiredBus, list[AnyBusEvent]]:
    """Run a program. Returns the results, the bus, and the log of the bus."""
    bus, log = WiredBus(defects=defects, seed=seed), list[AnyBusEvent]()
    bus.tell.append(log.append)
    vm = VirtualMachine(program, bus, poll=poll, statement_us=statement_us)
    vm.begin()
    while vm.turn and vm.memory.fault is None and bus.now < _LONGEST * _MICROSECONDS:
        poll()
        vm.statement()
        vm.settle()
    fault = vm.memory.fault
    endless = f"the program is still running after {_LONGEST} s"
    message = fault.told if fault else endless if vm.memory.tasks else ""
    sent = [event.frame for event in log if isinstance(event, CommandSent)]
    seconds = bus.now / _MICROSECONDS
    rate = len(sent) / seconds if seconds else 0.0
    known = {*sent}
    found = BusRun(
        completed=not message,
        message=message,
        seconds=seconds,
        commands=len(sent),
        per_second=rate,
        saturation=rate * bus.timing.command / _MICROSECONDS,
        idle=vm.idle,
        misread=sum(isinstance(event, FrameTaken) and event.frame not in known for event in log),
    )
    return found, bus, log


def lines(found: BusRun, log: Sequence[AnyBusEvent]) -> list[str]:
    """Describe the results of a run in sentences."""
    out = [
        found.message or ENDED,
        f"{counted(found.commands, 'command')} in {found.seconds:.3f} s: {found.per_second:.2f} a second, "
        f"{found.saturation:.3%} of what the bus can carry",
        f"the computer is idle for {found.idle:.1%} of the time",
    ]
    if found.misread:
        known = {event.frame for event in log if isinstance(event, CommandSent)}
        first = next(e for e in log if isinstance(e, FrameTaken) and e.frame not in known)
        frames = counted(found.misread, "frame")
        out.append(f"{frames} received that were never sent; the first: {spaced(first.frame)}")
    return out
