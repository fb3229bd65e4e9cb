"""MAL programs on perfect motors, for tests."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from handeye.core.source import Source
from handeye.program.events import SystemEvent
from handeye.systems.sigma.machine.perfect import PerfectMotors
from handeye.systems.sigma.mal.check import checked
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.happenings import CommandSent, Printed
from handeye.systems.sigma.mal.virtual_machine import STATEMENT_US, VirtualMachine

ROOT: Final = Path(__file__).parents[3]
PLANS: Final = ROOT / "plans"
TWO_TASKS: Final = "10 START LEFT, RIGHT\n20 END\n30 TASK LEFT\n{left}\n60 TASK RIGHT\n{right}"


@dataclass(slots=True)
class Ran:
    """A program that was carried out, as far as it went."""

    vm: VirtualMachine
    events: list[SystemEvent] = field(default_factory=list)
    statements: list[int] = field(default_factory=list)
    """The numbers of the lines, in the order in which they were carried out."""

    @property
    def printed(self) -> list[str]:
        return [event.text for event in self.events if isinstance(event, Printed)]

    @property
    def sent(self) -> list[CommandSent]:
        return [event for event in self.events if isinstance(event, CommandSent)]

    @property
    def fault(self) -> str:
        return "" if self.vm.memory.fault is None else self.vm.memory.fault.told


def mal(name: str) -> str:
    """The text of a program of `plans`."""
    return (PLANS / f"{name}.mal").read_text(encoding="utf-8")


def begun(text: str, *, statement_us: int = STATEMENT_US) -> Ran:
    """A program that has begun on perfect motors."""
    events: list[SystemEvent] = []
    vm = VirtualMachine(
        program_of("test.mal", text), PerfectMotors(), events.append, statement_us=statement_us
    )
    vm.begin()
    return Ran(vm, events)


def go_on(ran: Ran, most: int = 20_000) -> Ran:
    """Execute statements until none can be executed, or up to a number of them."""
    while ran.vm.turn and most:
        most -= 1
        task = ran.vm.memory.tasks[ran.vm.turn]
        ran.statements.append(ran.vm.program.line_of(task.pc).number)
        ran.vm.statement()
        ran.vm.settle()
    return ran


def carried_out(text: str, *, statement_us: int = STATEMENT_US) -> Ran:
    """A program carried out to its end, or to where it stands."""
    return go_on(begun(text, statement_us=statement_us))


def codes(text: str) -> list[str]:
    """The codes of a program's mistakes, by place."""
    return [each.code for each in checked(Source(name="test.mal", text=text))[1]]
