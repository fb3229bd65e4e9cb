"""ML from Python. The paper's host has a higher language that can invoke any of the ML functions; here that language
is Python."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from handeye.core.errors import BadArgument
from handeye.program.events import SystemEvent
from handeye.systems.ml.background.host import Host, Procedure
from handeye.systems.ml.background.interpreter import Interpreter
from handeye.systems.ml.background.program import StoredProgram
from handeye.systems.ml.cli.senses import sensed
from handeye.systems.ml.happenings import Printed
from handeye.systems.ml.language.syntax import Point
from handeye.systems.ml.machine.perfect import perfect_machine
from handeye.systems.ml.machine.surroundings import Stimulus

if TYPE_CHECKING:  # programs run on perfect motors without a simulator
    from handeye.systems.ml.bench.touch import Touch


class Ml:
    """A terminal of MOS, with the right arm enabled. The arm's motors are perfect: each motor is at its set-point
    after every cycle of 10 ms.

    >>> ml = handeye.Ml()
    >>> ml.do("MOTOR 3 2000"), ml.do("GETPOS 1 3"), ml.do("PRINT &1")
    ([], [], ['2000'])
    """

    def __init__(
        self,
        text: str = "",
        *,
        outline: Sequence[tuple[int, int]] = (),
        stimuli: Sequence[Stimulus] = (),
        senses: Sequence[str] = (),
        procedures: Mapping[str, Procedure] | None = None,
    ) -> None:
        """Switch MOS and the pump on.

        Args:
            text: a program to be stored.
            outline: corners of an object that the wand can touch, each as (y, x) in units of .001 inch.
            stimuli: values that sensors have at certain times or while a motor is at certain positions.
            senses: stimuli written as texts, as in `handeye ml run --sense`: with `5=500@3:2750`, sensor 5 reads
                500 while motor 3 is at 2750 or farther away from 0.
            procedures: a dictionary from the names of commands, `UPROCA` to `UPROCD`, to the functions that these
                commands call. Each function is called with the interpreter of this `Ml` and the values of the
                statement's parameters.
        """
        self.events: list[SystemEvent] = []
        sensing = (*stimuli, *map(sensed, senses))
        self._machine, _ = perfect_machine(self.events.append, stimuli=sensing, outline=outline)
        self._program = StoredProgram()
        self._mos = Interpreter(
            "right", self._machine.levels, self._program, self.events.append, Host(procedures)
        )
        self.do("ENABLE")
        self.load(text)

    @property
    def time(self) -> float:
        """Seconds since the beginning."""
        return self._mos.time

    @property
    def running(self) -> bool:
        """True if a program has begun and not ended."""
        return self._mos.running

    @property
    def stopped(self) -> str:
        """The error or emergency that has stopped the program; the text is empty if nothing has stopped the program."""
        return self._mos.memory.stopped

    @property
    def listing(self) -> list[str]:
        """The lines of the stored program, with one statement each."""
        return self._program.listing()

    def load(self, text: str) -> None:
        """Store the numbered lines of a program, and execute the lines that have no number. Raises MlError if a line
        cannot be executed, and BadArgument if a line cannot be read.
        """
        for line in text.splitlines():
            self.do(line)

    def do(self, line: str) -> list[str]:
        """Type a line, and wait until it has been executed. While a program is running, the line is executed between
        two statements of the program. If the line starts the program, `do` returns only when the program has ended.

        Returns:
            the lines that were printed.

        Raises:
            MlError: the line cannot be executed.
            BadArgument: the line cannot be read.
        """
        first, was_running = len(self.events), self.running
        self._mos.type_line(line)
        self._settle()
        while self.running and not was_running:
            self.step()
        return [event.text for event in self.events[first:] if isinstance(event, Printed)]

    def begin(self, first: int | None = None) -> None:
        """Start the stored program at a given statement, or at the first statement. `begin` executes no
        statement yet.
        """
        self._mos.run(first)

    def step(self, statements: int = 1) -> bool:
        """Execute statements, each to its end. Returns False if the program has ended."""
        if statements < 1:
            raise BadArgument(f"the number of statements must be at least 1, not {statements}")
        for _ in range(statements):
            if not self.running:
                break
            self._mos.statement()
            self._settle()
        return self.running

    def _settle(self) -> None:
        """Let cycles pass until no statement waits."""
        while not self._mos.ready():
            self._machine.cycle()

    def read(self, table: str, line: int, word: int = 1) -> int:
        """Return a word of a table, such as `read("MT", 3, 1)`. Raises MlError if the word does not exist."""
        return self._mos.level.read(table.upper(), line, word)

    def variable(self, number: int) -> int:
        """Return the value of a variable. Raises MlError if no variable has this number."""
        return self._mos.variable(number)

    def position(self, motor: int) -> int:
        """Return the position of a motor. Raises MlError if the motor is not installed."""
        return self._mos.level.position(motor)

    @staticmethod
    def touch(
        period: int = 10, bandwidth: float = 50.0, speed: float = 25.0, limit: int = 300, phase: float = 0.0
    ) -> "Touch":
        """Simulate, with physics, how the hand of the rectilinear arm descends on a block. A strain gauge in a finger
        guards the motion.

        >>> touch = handeye.Ml.touch(speed=50)
        >>> touch.noticed, touch.way, touch.force
        (10.0, 0.692, 13.71)

        Args:
            period: time from one reading of the sensors to the next (ms).
            bandwidth: bandwidth of the slide's servo (Hz).
            speed: speed of the slide (mm/s).
            limit: limit of the strain gauge (grams).
            phase: moment of the contact within the period. 0 is just after a reading; a value near 1 is just before
                the next reading.

        Returns: the touch. `noticed` is the time from the contact until the limit was noticed (ms). `way` is how far
            the slide moved after the contact (mm). `force` is the greatest force of both fingers (N), and `jolt` the
            force on a finger at the start of the motion (N). The touch also has the `places` (mm), `goals` (mm) and
            `forces` (N) at the `times` (ms).

        Raises:
            BadArgument: a value is out of range.
        """
        from handeye.systems.ml.bench.touch import touch

        return touch(period, bandwidth, speed, limit, phase)

    def point(self, number: int) -> Point:
        """Return the positions of a POINT. Raises MlError if the POINT is not filled."""
        return self._program.point(number)
