"""The MICROBUS from Python. The paper asks for "few functions that provide MICROBUS driving" in a general
language."""

from collections.abc import Sequence
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName
from handeye.ports.microbus import Command
from handeye.systems.sigma.bus.diagram import as_svg, as_text, diagram
from handeye.systems.sigma.bus.events import AnyBusEvent, CommandSent
from handeye.systems.sigma.bus.faults import defect
from handeye.systems.sigma.bus.layout import SUPERSIGMA
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.bus.words import event_text
from handeye.systems.sigma.diagnosis.power_on import power_on, told
from handeye.systems.sigma.protocol import ANSWERS, LONGEST_MOVE, Op, move, number_of, signed, within

_MICROSECONDS: Final = 1_000_000
_SIGNED: Final = {Op.POSITION, Op.ABORT_POSITION, Op.FORCE}
_LONGEST_WAIT: Final = 86_400  # s


class Microbus:
    """A MICROBUS with the ten microcomputers of SUPERSIGMA, connected to an ideal machine whose rotors follow each
    pulse.

    >>> bus = handeye.Microbus()
    >>> bus.command("X1", steps=800)
    >>> bus.status("X1"), bus.wait("X1"), bus.ask("X1", "POSITION")
    ('busy', 'free', 800)
    """

    def __init__(self, *, faults: Sequence[str] = (), seed: int = 0, clock_spread: float = 0.0) -> None:
        """Switch the bus on.

        Args:
            faults: injected faults, written like `--fault` of `handeye sigma bus demo`, for example `clock:X1:200`.
            seed: seed of the random numbers. These are the times at which the microcomputers begin to poll, and the
                errors of their clocks.
            clock_spread: greatest clock error, as a fraction, for example .005.
        """
        if not 0 <= clock_spread < 1:
            raise BadArgument(f"the clock error must be a fraction from 0 to 1, not {clock_spread:g}")
        self._bus = WiredBus(defects=[defect(text) for text in faults], seed=seed, clock_spread=clock_spread)
        self._log: list[AnyBusEvent] = []
        self._bus.tell.append(self._log.append)

    @property
    def now(self) -> float:
        """Seconds since power-on."""
        return self._bus.now / _MICROSECONDS

    @property
    def interrupt(self) -> bool:
        """True if line A of any motor is high. Line A of a motor is high if the motor's last command was aborted."""
        return self._bus.interrupt

    def command(
        self,
        name: str | int,
        op: str = "MOVE",
        *,
        steps: int = 0,
        curve: int = 0,
        detail: int = 0,
        value: int = 0,
    ) -> None:
        """Send a command of five bytes.

        Args:
            name: the name (`X1`, `FORCE1`, `HAND2`) or the number of a microcomputer.
            op: the operation. For an operation that is a question, use `ask`.
            steps: signed distance of a MOVE (steps).
            curve: acceleration curve of a MOVE, 0 to 4.
            detail: byte 3 of other operations.
            value: bytes 4 and 5 of other operations.

        Raises:
            NoSuchName: no microcomputer has the name `name`, or no operation has the name `op`.
            BadArgument: a number is outside its range, or the operation is a question.
        """
        kind = _op(op)
        if kind in ANSWERS:
            raise BadArgument(f"{kind.name} is a question; use ask({name!r}, {kind.name!r})")
        self._bus.send(move(name, steps, curve) if kind is Op.MOVE else _command(name, kind, detail, value))

    def ask(self, name: str | int, op: str = "POSITION", *, detail: int = 0, count: int | None = None) -> int:
        """Ask a microcomputer, and wait for its answer. Returns the answer as a number, which is signed for
        POSITION, ABORT_POSITION and FORCE.

        Raises:
            NoAnswer: the answer did not arrive within 5 ms.
        """
        kind = _op(op)
        if count is None and kind not in ANSWERS:
            raise BadArgument(
                f"the answer to {kind.name} has no known length; give its number of bytes as `count`"
            )
        length = ANSWERS[kind] if count is None else within(count, 1, 255, "the length of an answer")
        answer = self._bus.ask(_command(name, kind, detail, 0), length)
        return signed(answer) if kind in _SIGNED else int.from_bytes(answer, "big")

    def status(self, name: str | int) -> str:
        """Return the state of a microcomputer: `free` or `busy`. If its last command was aborted, return the reason
        for the abort (`rail` or `force`).
        """
        return self._bus.status(number_of(name)).name.lower()

    def wait(self, name: str | int, seconds: float = 60.0) -> str:
        """Wait for at most `seconds` until a microcomputer is no longer busy. Returns the state of the microcomputer,
        as `status` does.
        """
        return self._bus.wait_free(number_of(name), _microseconds(seconds)).name.lower()

    def pause(self, seconds: float) -> None:
        """Let this many seconds pass."""
        end = self._bus.now + _microseconds(seconds)
        while self._bus.now < end:
            self._bus.wait(end)

    def self_test(self) -> list[str]:
        """Run the power-on self-tests, and return their results in sentences."""
        return told(power_on(self._bus, SUPERSIGMA))

    @property
    def frames(self) -> list[str]:
        """The bytes of all commands so far, in hexadecimal."""
        return [event.frame.hex(" ") for event in self._log if isinstance(event, CommandSent)]

    @property
    def log(self) -> list[str]:
        """The log of the bus, one line per event. Each line begins with the time in microseconds."""
        return [event_text(event) for event in sorted(self._log, key=lambda event: event.at)]

    def diagram(self, begin: float = 0.0, end: float | None = None, *, width: int = 100) -> str:
        """Return the timing diagram between two times (s) as text."""
        return "\n".join(
            as_text(diagram("", self._log, *self._span(begin, end), self._bus.timing), width)[1:]
        )

    def svg(self, begin: float = 0.0, end: float | None = None, *, title: str = "MICROBUS") -> str:
        """Return the timing diagram between two times (s) as SVG."""
        return as_svg(diagram(title, self._log, *self._span(begin, end), self._bus.timing))

    def _span(self, begin: float, end: float | None) -> tuple[int, int]:
        first = _microseconds(begin)
        last = self._bus.now if end is None else _microseconds(end)
        if last <= first:
            raise BadArgument(
                f"a diagram must end after its beginning; this one would go from {begin:g} s to {last / 1e6:g} s"
            )
        return first, last


def _op(name: str) -> Op:
    if name.upper() not in Op.__members__:
        raise NoSuchName(
            f"there is no operation {quoted(name)}; the operations are {', '.join(Op.__members__)}"
        )
    return Op[name.upper()]


def _command(name: str | int, op: Op, detail: int, value: int) -> Command:
    return Command(
        number=number_of(name),
        op=op,
        detail=within(detail, 0, 0xFF, "the detail of a command"),
        value=within(value, 0, LONGEST_MOVE, "the value of a command"),
    )


def _microseconds(seconds: float) -> int:
    if not 0 <= seconds <= _LONGEST_WAIT:
        raise BadArgument(f"a time on the bus must be between 0 and {_LONGEST_WAIT} s, not {seconds:g} s")
    return round(seconds * _MICROSECONDS)
