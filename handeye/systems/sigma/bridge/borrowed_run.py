"""Runs a MAL program with the Stanford arm in place of arm 1."""

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Final

from handeye.core.errors import BadFile, Refused
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.ports.microbus import Status
from handeye.program.events import SystemEvent
from handeye.systems.sigma.mal.check import expressions, parts, within
from handeye.systems.sigma.mal.compiler import MalProgram
from handeye.systems.sigma.mal.scanner import Token
from handeye.systems.sigma.mal.syntax import Call, Line
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.mal.words import MAL_DEVICES
from handeye.systems.sigma.protocol import AXES, LINE_NUMBERS

if TYPE_CHECKING:
    from handeye.systems.sigma.bridge.borrowed_arm import BorrowedArm

SAID: Final = (
    "The Stanford arm takes the place of arm 1. There is no bus: no bytes are sent, and no reflex stops a motor within "
    "a millisecond."
)
_LONGEST_US: Final = 3_600_000_000


class BorrowedRun(Record, frozen=True, kw_only=True):
    """The results of a program on the borrowed arm."""

    completed: bool
    message: str  # why the program did not finish; empty if it did
    seconds: float
    commands: int  # commands of the computer; none of them was sent over a bus
    bus: bool = False
    most_n: float  # the greatest force that the arm felt along an axis
    error_mm: float  # at the end: greatest distance of the tool from the counts, along any axis


def check_program(lines: Sequence[Line]) -> None:
    """Raise BadFile for the first line that needs a device, an axis or a sensor which the borrowed arm lacks."""
    for line in lines:
        why = next(_lacks(line), None)
        if why is not None:
            raise BadFile(f"line {line.number} {why}; the Stanford arm replaces only arm 1")


def _lacks(line: Line) -> Iterator[str]:
    """Yield the devices, axes and sensors that a line needs and that the borrowed arm lacks."""
    for statement in within(line.statement):
        names = [*(name.text for name in statement.names), *(goal.axis.text for goal in statement.goals)]
        for name in names:
            if (name in MAL_DEVICES and name != "HAND1") or (name in AXES and name[1] == "2"):
                yield f"uses {name}"
        for expression in expressions(statement):
            for part in parts(expression):
                match part:
                    case Call("BEAM"):
                        yield "asks for a light beam"
                    case Call(argument=Token(text=axis)) if axis in AXES and axis[1] == "2":
                        yield f"uses {axis}"


def run_borrowed(
    program: MalProgram,
    arm: "BorrowedArm",
    tell: Callable[[SystemEvent], None] = lambda _: None,
    poll: Callable[[], None] = lambda: None,
) -> BorrowedRun:
    """Execute a MAL program on the arm that replaces the arm of SUPERSIGMA."""
    vm = VirtualMachine(program, arm, tell, poll=poll)
    message = ""
    try:
        vm.begin()
        while vm.turn and vm.memory.fault is None and arm.now < _LONGEST_US:
            poll()
            vm.statement()
            vm.settle()
    except Refused as refused:
        message = f"{_whose(vm, arm)}{refused}"
    fault = vm.memory.fault
    return BorrowedRun(
        completed=fault is None and not message and not vm.memory.tasks,
        message=message if fault is None else fault.told,
        seconds=round(vm.time, 3),
        commands=vm.memory.commands,
        most_n=round(arm.most, 2),
        error_mm=round(arm.error, 2),
    )


def _whose(vm: VirtualMachine, arm: "BorrowedArm") -> str:
    """Name the task and the line of a motion under way."""
    for axis, owner in vm.memory.owners.items():
        if arm.status(LINE_NUMBERS[axis]) is Status.BUSY:
            return f"the task {owner.task}, line {vm.program.line_of(owner.address).number}: "
    return ""


def lines(found: BorrowedRun) -> list[str]:
    """Describe the results of a run in sentences."""
    return [
        found.message or "all tasks have ended",
        f"{counted(found.commands, 'command')} in {found.seconds:.1f} s, none of them over a bus",
        f"the arm felt up to {found.most_n:.1f} N along an axis",
        f"at the end, the tool is up to {found.error_mm:.1f} mm from the position that the axes have counted",
    ]
