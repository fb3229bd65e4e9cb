"""The interpreter of ML: it executes the typed and the stored statements of one arm. If a statement must wait, the
memory records the condition. The caller then lets cycles pass until `ready` returns True.
"""

from collections.abc import Callable, Mapping
from typing import Final

from handeye.core.errors import BadArgument, BadFile, InvalidInput
from handeye.core.mutable_records import MutableRecord, put_back
from handeye.program.events import SystemEvent
from handeye.systems.ml.arithmetic import fits
from handeye.systems.ml.background.behaviour import BEHAVIOUR
from handeye.systems.ml.background.host import Host
from handeye.systems.ml.background.memory import KEPT, BackgroundMemory
from handeye.systems.ml.background.motion import jog
from handeye.systems.ml.background.program import StoredProgram
from handeye.systems.ml.background.views import NUMBERS, show_tables
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.happenings import Printed, Traced
from handeye.systems.ml.language.parser import statement_of
from handeye.systems.ml.language.syntax import VARIABLES, Parameter, Reference, Statement, statement_text
from handeye.systems.ml.level import Level, Side

CYCLES_PER_SECOND: Final = 100
Value = int | str


class Interpreter:
    """The background level of one arm."""

    def __init__(
        self,
        side: Side,
        levels: Mapping[Side, Level],
        program: StoredProgram,
        tell: Callable[[SystemEvent], None],
        host: Host | None = None,
        *,
        joystick: bool = False,
    ) -> None:
        """Begin with no program running. `levels` has the real-time levels of all installed arms. If `host` is None,
        the commands that need a host raise an error.
        """
        self.levels, self.program, self.host = levels, program, host
        self._own = levels[side]  # the program uses its registers and clock, whichever arm it commands
        self.memory = BackgroundMemory(side=side)
        self.joystick = joystick
        self._tell = tell
        show_tables(self, self._own)

    @property
    def level(self) -> Level:
        """The real-time level of the arm that the program now commands."""
        return self.levels[self.memory.side]

    @property
    def _emergency(self) -> str:
        """The emergency that has stopped the arm that the program now commands, or the program's own arm. The string
        is empty if neither arm was stopped.
        """
        return self.level.stopped or self._own.stopped

    @property
    def running(self) -> bool:
        """True while a program runs or a statement waits."""
        return bool(self.memory.at or self.memory.waits)

    def remember(self, memory: MutableRecord) -> None:
        """Continue from a copy of a state. Raises BadFile if the state does not fit this machine."""
        if not isinstance(memory, BackgroundMemory) or memory.side not in self.levels:
            raise BadFile("the state of the program does not fit this machine")
        put_back(self.memory, memory)

    # -- execution ------------------------------------------------------------------------------------

    def run(self, first: int | None = None) -> None:
        """Start the stored program at a statement, or at its first statement. Raises MlError if the program is empty or
        has no statement with this number (M07), or if an emergency has stopped the arm (M14).
        """
        if why := self._emergency:
            raise MlError("M14", f"an emergency has stopped the arm: {why}; ENABLE the arm first")
        if first is None and not self.program.numbers:
            raise MlError("M07", "no program is stored")
        first = self.program.numbers[0] if first is None else first
        self.program.statement(first)
        memory = self.memory
        for line in (1, 2, 3):
            for word in range(1, 6):
                self.set_register(line, word, 0)
        memory.at, memory.stopped, memory.onward, memory.trying = first, "", 0, False

    def end(self) -> None:
        """End the program."""
        self.memory.at, self.memory.waits, self.memory.trying = 0, "", False

    def conclude(self) -> None:
        """End the program. If a last look at the sensors and interlocks finds an emergency, the program counts as
        stopped by that emergency.
        """
        self.end()
        for level in (self._own, self.level):
            level.look()
        self.check()

    def check(self) -> bool:
        """Stop the program if an emergency has stopped the arm. Returns True if an emergency has stopped the program,
        now or earlier.
        """
        if not self.memory.stopped and (why := self._emergency):
            self._stop(why)
        return bool(self.memory.stopped)

    def ready(self) -> bool:
        """If a statement waits for a condition that is now met, end the wait. Returns True if no statement waits any
        longer. In an emergency, stops the program.
        """
        memory, level = self.memory, self.level
        if self.running and self.check():
            return True
        if memory.waits == "joy" and not jog(self):
            return False
        over = {"": True, "joy": True, "post": bool(level.posted), "until": level.now >= memory.until}
        if not over[memory.waits]:
            return False
        memory.waits = ""
        return True

    def statement(self) -> None:
        """Execute the next stored statement. If the statement causes an error, the error is an emergency, which stops
        the program.
        """
        memory = self.memory
        number = memory.at
        if not number:
            return
        memory.executing, memory.at = number, self.program.after(number)
        self._own.statement(number)
        try:
            self._execute(self.program.statement(number))
        except InvalidInput as error:
            self.level.emergency("PROGRAM", number)
            self._stop(f"{error} (statement {number})")
            return
        if not memory.waits:
            self._count()
        if not self.running:
            self.conclude()

    def type_line(self, text: str) -> None:
        """Store a line that has a sequence number; execute any other line. If MlError or BadArgument is raised,
        nothing has changed.
        """
        line = statement_of(text)
        if self.memory.waits and line is not None and line.number is None:
            raise BadArgument("a statement is still being executed; wait for its end")
        self.memory.typed[:] = [*self.memory.typed[1 - KEPT :], text]
        if line is None:
            return
        if line.number is not None:
            self.program.store(line.number, line.statement)
            return
        executing, self.memory.executing = self.memory.executing, 0
        self._own.statement(0)
        try:
            self._execute(line.statement)
        except InvalidInput:
            self.memory.executing = executing
            raise

    def file(self, text: str) -> None:
        """Execute a typed command FILE while another statement is being executed. If MlError or BadArgument is raised,
        nothing has changed.
        """
        line = statement_of(text)
        if line is None or line.number is not None or line.statement.code != "FILE":
            raise BadArgument("while a statement is being executed, you can type only the command FILE")
        BEHAVIOUR["FILE"](self, *map(self._value, line.statement.parameters))
        self.memory.typed[:] = [*self.memory.typed[1 - KEPT :], text]

    def again(self, *, onward: bool) -> None:
        """After a stop, enable the arm. Then continue with the next statement if `onward` is True; if it is False,
        repeat the statement that was stopped. Raises MlError (M14) while the cause of an emergency persists.
        """
        memory = self.memory
        for level in (self._own, self.level):
            if level.stopped:
                level.enable()
        memory.at = memory.onward if onward else memory.executing
        memory.stopped, memory.onward = "", 0

    def _execute(self, statement: Statement) -> None:
        memory, code = self.memory, statement.code
        values: list[Value] = [self._value(each) for each in statement.parameters]
        if memory.tracing or memory.trying:
            numbers = tuple(each for each in values if isinstance(each, int))
            memory.traced[:] = [*memory.traced[1 - KEPT :], (memory.executing, NUMBERS[code], *numbers[:14])]
            text = statement_text(code, tuple(values))
            self._tell(Traced(time=self.time, statement=memory.executing, text=text))
        BEHAVIOUR[code](self, *values)

    def _stop(self, why: str) -> None:
        memory = self.memory
        memory.onward = memory.at
        self.end()
        memory.stopped = why

    def _count(self) -> None:
        """Count the statement. If the computer has no time for another statement in this cycle, wait for the next
        cycle.
        """
        memory, level = self.memory, self._own
        if memory.cycle != level.now:
            memory.cycle, memory.share = level.now, 0
        memory.share += 1
        if memory.share >= max(1, level.read("CY", 1, 5)):
            self.wait_until(level.now + 1)

    # -- for the commands -----------------------------------------------------------------------------

    @property
    def time(self) -> float:
        """Seconds since the beginning."""
        return self._own.now / CYCLES_PER_SECOND

    def tell(self, event: SystemEvent) -> None:
        self._tell(event)

    def print(self, text: str) -> None:
        """Print a line on the terminal."""
        self._tell(Printed(time=self.time, text=text))

    def go(self, number: int) -> None:
        """Continue at a statement. A typed branch starts the program at that statement. Raises MlError (M07) if the
        program has no statement with this number.
        """
        self.program.statement(number)
        if self.memory.executing:
            self.memory.at = number
        else:
            self.run(number)

    def wait_until(self, cycle: int) -> None:
        self.memory.waits, self.memory.until = "until", cycle

    def variable(self, number: int) -> int:
        """Return the value of a variable. Raises MlError (M05) if no variable has this number."""
        return self.level.read("VR", _variable(number), 1)

    def set_variable(self, number: int, value: int) -> None:
        """Set a variable. Raises MlError (M05) if no variable has this number."""
        self.level.write("VR", _variable(number), 1, value)

    def register(self, line: int, word: int) -> int:
        return self._own.read("RG", line, word)

    def set_register(self, line: int, word: int, value: int) -> None:
        self._own.write("RG", line, word, value)

    def _value(self, parameter: Parameter) -> Value:
        if not isinstance(parameter, Reference):
            return parameter
        value = parameter.index
        for _ in range(parameter.depth):
            value = self.variable(value)
        if parameter.negative:
            value = -value
            if not fits(value):
                raise MlError("M04", f"{value} does not fit into 16 bits")
        return value


def _variable(number: int) -> int:
    if not 1 <= number <= VARIABLES:
        raise MlError("M05", f"there is no variable {number}; variables are numbered from 1 to {VARIABLES}")
    return number
