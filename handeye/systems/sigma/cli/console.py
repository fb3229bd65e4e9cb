"""The console of 1981. Lines with a number form a program; all other lines are executed at once."""

import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Final, NamedTuple

from handeye.core.diagnostics import has_errors, quoted, render, suggestion
from handeye.core.errors import BadArgument, InvalidInput, NoSuchName, Refused
from handeye.core.files import check_new, write_whole
from handeye.core.plain_text import counted
from handeye.core.source import Source, read_source
from handeye.execution.servo import Halted
from handeye.ports.microbus import Status
from handeye.program.events import SystemEvent
from handeye.systems.sigma.machine.perfect import PerfectMotors
from handeye.systems.sigma.mal.compiler import MalProgram, compile_source
from handeye.systems.sigma.mal.happenings import Printed
from handeye.systems.sigma.mal.language import tidy
from handeye.systems.sigma.mal.parser import MOST_LINES, parsed, parsed_line
from handeye.systems.sigma.mal.syntax import MAIN
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import NUMBERS, STEP_MM

ENDING: Final = ".mal"


class ConsoleCommand(NamedTuple):
    """A command of the console."""

    usage: str
    help: str


COMMANDS: Final = {
    "NEW": ConsoleCommand("NEW", "begin with an empty program"),
    "LOAD": ConsoleCommand("LOAD FILE", "read a program"),
    "SAVE": ConsoleCommand("SAVE FILE", "write the program to a new file"),
    "LIST": ConsoleCommand("LIST [FIRST[-LAST]]", "show the lines of the program"),
    "COMPILE": ConsoleCommand("COMPILE", "check the program, and show the size of its code"),
    "RUN": ConsoleCommand("RUN", "run the program from the beginning"),
    "BREAK": ConsoleCommand(
        "BREAK [LINE]", "stop before this line; without a line, remove the stop. Ctrl-C stops immediately"
    ),
    "CONT": ConsoleCommand("CONT", "continue from where the program has stopped"),
    "STATUS": ConsoleCommand("STATUS", "show the microcomputers"),
    "HELP": ConsoleCommand("HELP", "show this list of commands"),
    "BYE": ConsoleCommand("BYE", "leave"),
}


class Console:
    """A session at the console. It holds the program, and the machine as the last run left it."""

    def __init__(
        self,
        tell: Callable[[str], None],
        ask: Callable[[str], str | None] = lambda _: None,
        halted: Callable[[], bool] = lambda: False,
    ) -> None:
        """Begin a session. `ask` returns the line that the user types as an answer, or None at the end of the
        input."""
        self._tell, self._ask, self._halted = tell, ask, halted
        self._lines: dict[int, str] = {}
        self._machine, self._vm = PerfectMotors(), None
        self._stop: int | None = None
        self._paused = False  # True: the program has stopped before the line of BREAK
        self.over = False

    _vm: VirtualMachine | None

    @property
    def text(self) -> str:
        """The text of the program."""
        return "".join(f"{number} {self._lines[number]}\n" for number in sorted(self._lines))

    def words(self) -> Iterable[str]:
        return COMMANDS

    def hear(self, line: str) -> None:
        """Execute a line. If the line cannot be executed, change nothing and raise InvalidInput."""
        line = line.strip()
        if not line:
            return
        if line[0].isdigit():
            self._enter(line)
            return
        word, _, rest = line.partition(" ")
        word, rest = word.upper(), rest.strip()
        if word not in COMMANDS:
            near = suggestion(word, COMMANDS) or "HELP lists the commands"
            raise NoSuchName(f"{quoted(word)} is not a command; {near}")
        if rest and " " not in COMMANDS[word].usage:
            raise BadArgument(f"{word} takes no operand; remove {quoted(rest)}")
        getattr(self, f"_{word.lower()}")(rest)

    # -- the program ----------------------------------------------------------------------------------

    def _enter(self, line: str) -> None:
        """Store a line with a number. A number alone removes the line that has this number."""
        if bare := re.fullmatch(r"([0-9]{1,5})", line):
            if int(bare[1]) not in self._lines:
                raise NoSuchName(f"there is no line {bare[1]}")
            del self._lines[int(bare[1])]
        else:
            found, wrong = parsed_line(line, 0, 1, MAIN)
            if wrong is not None:
                raise BadArgument(f"{wrong.message}; {wrong.help}")
            assert found is not None
            if len(self._lines) >= MOST_LINES and found.number not in self._lines:
                raise Refused(f"a program can have at most {MOST_LINES} lines")
            self._lines[found.number] = tidy(found.text)
        self._vm = None

    def _new(self, _: str) -> None:
        self._lines, self._vm, self._stop = {}, None, None

    def _load(self, name: str) -> None:
        if not name:
            raise BadArgument("give LOAD the name of a file, such as `LOAD pieces.mal`")
        source = read_source(Path(name))
        lines, wrong = parsed(source)
        if wrong:
            row, _ = source.position(wrong[0].primary.span.start)
            raise BadArgument(f"{name}:{row}: {wrong[0].message}; `handeye check` shows all mistakes")
        if len({line.number for line in lines}) < len(lines):
            raise BadArgument(f"{name} has two lines with the same number")
        self._new("")
        self._lines = {line.number: line.text for line in lines}
        self._tell(counted(len(lines), "line"))

    def _save(self, name: str) -> None:
        if not name:
            raise BadArgument("give SAVE the name of a new file, such as `SAVE pieces.mal`")
        if not self._lines:
            raise Refused("there is no program")
        path = Path(name if name.lower().endswith(ENDING) else f"{name}{ENDING}")
        check_new(path)
        write_whole(path, self.text.encode())
        self._tell(f"{path}: {counted(len(self._lines), 'line')}")

    def _list(self, which: str) -> None:
        found = re.fullmatch(r"(?:([0-9]{1,5})(?:\s*(-)\s*([0-9]{1,5})?)?)?", which)
        if found is None:
            raise BadArgument(f"LIST takes one line or a range, such as 100-200, not {quoted(which)}")
        first, dash, last = found.groups()
        low = int(first) if first else 0
        high = int(last) if last else low if first and not dash else max(self._lines, default=0)
        for number in sorted(self._lines):
            if low <= number <= high:
                self._tell(f"{number} {self._lines[number]}")

    def _compiled(self) -> MalProgram:
        source = Source(name="program", text=self.text)
        program, found = compile_source(source)
        for each in found:
            self._tell(render(each, source))
        if program is None or has_errors(found):
            raise Refused(
                f"{counted(sum(each.severity == 'error' for each in found), 'mistake')}: the program is not run"
            )
        if not program.lines:
            raise Refused("there is no program")
        program.check_alone()
        return program

    def _compile(self, _: str) -> None:
        program = self._compiled()
        tasks = ", ".join(program.tasks)
        size = f"{counted(len(program.lines), 'statement')}, {counted(len(program.code), 'instruction')}"
        self._tell(f"{size}; {counted(len(program.tasks), 'task')}: {tasks}")

    # -- running --------------------------------------------------------------------------------------

    def _run(self, _: str) -> None:
        program = self._compiled()
        self._machine = PerfectMotors()
        self._vm = VirtualMachine(program, self._machine, self._hear_event, poll=self._poll)
        self._carry_on(self._vm.begin)

    def _cont(self, _: str) -> None:
        vm = self._vm
        if vm is None or not vm.memory.tasks:
            raise Refused("no program is running; RUN starts the program")
        if vm.memory.fault is not None:
            self._carry_on(vm.proceed)
        elif self._paused:
            self._carry_on(vm.statement, vm.settle)
        else:
            self._carry_on(vm.settle)

    def _break(self, line: str) -> None:
        if not line:
            self._stop = None
        elif not line.isdigit() or int(line[:6]) not in self._lines:
            raise BadArgument(f"BREAK takes the number of a line, not {quoted(line)}")
        else:
            self._stop = int(line)

    def _carry_on(self, *first: Callable[[], None]) -> None:
        """Execute statements until the program ends, stops, reaches a breakpoint, or is interrupted."""
        assert self._vm is not None
        vm, self._paused = self._vm, False
        try:
            for act in first:
                act()
            while True:
                if vm.memory.fault is not None and vm.memory.fault.kind == "input" and self._answered(vm):
                    continue
                if not vm.turn:
                    break
                number = vm.program.line_of(vm.memory.tasks[vm.turn].pc).number
                if number == self._stop:
                    self._paused = True
                    self._tell(
                        f"BREAK before line {number}, in the task {vm.turn}, at {vm.time:.3f} s; CONT continues"
                    )
                    return
                vm.statement()
                vm.settle()
        except Halted:
            self._tell(f"BREAK at {vm.time:.3f} s; CONT continues")
            return
        if vm.memory.fault is not None:
            self._tell(vm.memory.fault.told)
            return
        sent = counted(vm.memory.commands, "command")
        self._tell(f"{sent} in {vm.time:.3f} s; the computer was idle for {vm.idle:.0%} of the time")

    def _answered(self, vm: VirtualMachine) -> bool:
        """Ask the user for the number for which a task waits. Returns False at the end of the input."""
        assert vm.memory.fault is not None
        line = self._ask("? ")
        if line is None:
            return False
        try:
            vm.type_number(line.strip())
        except InvalidInput as error:
            self._tell(str(error))
            return True
        vm.settle()
        return True

    def _hear_event(self, event: SystemEvent) -> None:
        if isinstance(event, Printed):
            self._tell(event.text)

    def _poll(self) -> None:
        if self._halted():
            raise Halted

    # -- the machine ----------------------------------------------------------------------------------

    def _status(self, _: str) -> None:
        """Print a table of the microcomputers."""
        memory = self._machine.memory
        for name, number in NUMBERS.items():
            status = self._machine.status(number)
            lines = f"{status >> 1}-{status & 1}"
            place = f"{memory.motors[number].count * STEP_MM:10.4f} mm" if number in memory.motors else ""
            self._tell(f"{number:3}  {name:6}  {lines}  {_MEANINGS[status]:14}  {place}".rstrip())

    def _help(self, _: str) -> None:
        width = max(len(each.usage) for each in COMMANDS.values())
        for each in COMMANDS.values():
            self._tell(f"{each.usage:{width}}  {each.help}")
        self._tell(
            "To add a line to the program, start it with its number. To remove a line, enter only its number."
        )

    def _bye(self, _: str) -> None:
        self.over = True


_MEANINGS: Final = {
    Status.FREE: "free", Status.BUSY: "busy", Status.RAIL: "rail aborted", Status.FORCE: "force aborted",
}  # fmt: skip
