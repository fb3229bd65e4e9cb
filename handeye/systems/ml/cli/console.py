"""The terminal of 1975. Lines with a sequence number are stored; all other lines are executed at once."""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Final

from handeye.core.errors import InvalidInput
from handeye.core.files import check_new, write_whole
from handeye.core.plain_text import counted
from handeye.core.source import Source, read_source
from handeye.core.units import MILLIMETRES
from handeye.program.events import SystemEvent
from handeye.systems.ml.background.host import Host, replace_program
from handeye.systems.ml.background.interpreter import Interpreter
from handeye.systems.ml.background.motion import CANCEL, RECORD
from handeye.systems.ml.background.program import StoredProgram
from handeye.systems.ml.background.views import show_tables
from handeye.systems.ml.happenings import Nullified, Printed, Traced
from handeye.systems.ml.language.commands import COMMANDS
from handeye.systems.ml.machine.perfect import perfect_machine
from handeye.systems.ml.realtime.happenings import EmergencyStopped, GoalRounded

ENDING: Final = ".ml"
_KEYS: Final = "type N to execute the statement, R to run on without asking, or A to abandon the program"
_JOYSTICK: Final = (
    "to move a motor, type its number and a distance; RECORD stores the positions; CANCEL keeps the earlier "
    "positions of the POINT"
)


class FileHost(Host):
    """A host that keeps programs in files of the current folder, and can start the interpreter of the arm language of
    1973.
    """

    def read(self, name: str) -> str:
        return read_source(_path(name)).text

    def write(self, name: str, text: str) -> None:
        path = _path(name)
        check_new(path)
        write_whole(path, text.encode())

    def interpreter(self) -> None:
        """Run `handeye repl` until the user leaves it."""
        from handeye.cli.teaching import repl

        repl()


def _path(name: str) -> Path:
    return Path(name if name.lower().endswith(ENDING) else f"{name}{ENDING}")


class Console:
    """A session at the terminal, with arms whose motors are perfect."""

    def __init__(
        self,
        say: Callable[[str], None],
        ask: Callable[[str], str | None] = lambda _: None,
        halted: Callable[[], bool] = lambda: False,
        *,
        left: bool = False,
    ) -> None:
        """Begin a session with a right arm and, if `left` is true, also a left arm. The pump is off. `ask` shows a
        prompt and returns what the user types, or None at the end of the input. `halted` returns True when the panic
        button has been pressed.
        """
        self._say, self._ask, self._halted = say, ask, halted
        self._machine, self._arms = perfect_machine(
            self._hear_event, sides=("right", "left") if left else ("right",)
        )
        self._program = StoredProgram()
        self._mos = Interpreter(
            "right", self._machine.levels, self._program, self._hear_event, FileHost(), joystick=True
        )
        for level in self._machine.levels.values():
            show_tables(self._mos, level)

    @property
    def over(self) -> bool:
        """True after EXIT."""
        return self._mos.memory.left

    def words(self) -> Iterable[str]:
        """Words that completion offers."""
        return COMMANDS

    def load(self, source: Source) -> None:
        """Store the program of a file. Raises BadFile if the program has mistakes."""
        replace_program(self._mos, source)
        self._say(counted(len(self._program.numbers), "statement"))

    def hear(self, line: str) -> None:
        """Execute a line to its end. If the line starts a program, execute this program to its end, too. Raises
        InvalidInput if the line cannot be executed.
        """
        if line.strip().upper() == "HELP":
            self._help()
            return
        self._mos.type_line(line)
        while self._mos.running:
            self._pass_time()
            if self._mos.memory.trying and not self._tried():
                self._mos.end()
            else:
                self._mos.statement()
        memory = self._mos.memory
        if memory.stopped and memory.stopped != self._mos.level.stopped:  # an emergency has been shown
            self._say(memory.stopped)
        memory.stopped = ""

    def _pass_time(self) -> None:
        """Let cycles pass until the next statement can be executed. Ctrl-C is the panic button."""
        while not self._mos.ready():
            if self._mos.memory.waits == "joy":
                self._guide()
            if self._halted():
                self._press_panic_button()
            self._machine.cycle()

    def _press_panic_button(self) -> None:
        """Press the panic button for two cycles, so that an arm with a period of two cycles also notices it."""
        for on in (1, 0):
            for arm in self._arms.values():
                arm.switch("panic", on)
            if on:
                self._machine.cycle()
                self._machine.cycle()

    def _tried(self) -> bool:
        """Show the next statement, and wait for a key. Returns False if the program is to be abandoned."""
        memory = self._mos.memory
        if not memory.at:
            return True
        while True:
            key = self._ask(f"{self._program.listing(memory.at, memory.at)[0]} ? ")
            match "A" if key is None else key.strip().upper():
                case "" | "N":
                    return True
                case "R":
                    memory.trying = False
                    return True
                case "A":
                    return False
            self._say(_KEYS)

    def _guide(self) -> None:
        """Ask for a command of the joystick, and execute it."""
        level, point = self._mos.level, self._mos.memory.joy
        typed = self._ask(f"JOY {point} ? ")
        words = ["CANCEL"] if typed is None else typed.upper().split()
        match words:
            case ["RECORD"]:
                level.write("FK", 1, 1, RECORD)
            case ["CANCEL"]:
                level.write("FK", 1, 1, CANCEL)
            case [motor, distance] if _number(motor) is not None and _number(distance) is not None:
                self._jog(_number(motor) or 0, _number(distance) or 0)
            case _:
                self._say(_JOYSTICK)

    def _jog(self, motor: int, distance: int) -> None:
        level = self._mos.level
        try:
            if level.start({motor: level.goal(motor) + distance}):
                while not level.posted:
                    self._machine.cycle()
                self._say(f"motor {motor} is at {level.position(motor)}")
            else:
                self._say(
                    f"the flag of sensor {min(level.flags)} is on: type CANCEL, then clear the flag with SENSOR"
                )
        except InvalidInput as error:
            self._say(str(error))

    def _hear_event(self, event: SystemEvent) -> None:
        match event:
            case Printed(text=text):
                self._say(text)
            case Traced(statement=number, text=text):
                if number and not self._mos.memory.trying:
                    self._say(f"{number} {text}")
            case Nullified(statement=0) | EmergencyStopped() | GoalRounded():
                self._say(event.sentence(MILLIMETRES))

    def _help(self) -> None:
        for category in dict.fromkeys(command.category for command in COMMANDS.values()):
            self._say(category)
            for command in COMMANDS.values():
                if command.category == category:
                    self._say(f"  {command.form}")
        self._say(
            "A line with a sequence number is stored; any other line is executed immediately. Ctrl-C is the panic "
            "button."
        )


def _number(text: str) -> int | None:
    try:
        return int(text)
    except ValueError:
        return None
