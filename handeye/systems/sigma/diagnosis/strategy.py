"""Runs the tests in the order of the paper: first the computer, the bus, interfaces and microcomputers, then
transducers and drives.

The strategy uses only the results of tests, not the planted fault. The verdict names a part, or says that no test can
decide which part is faulty.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Final, Protocol, TypeVar

from handeye.core.record import Record
from handeye.ports.microbus import Status
from handeye.systems.sigma.diagnosis import means
from handeye.systems.sigma.diagnosis.means import Motion, Technician
from handeye.systems.sigma.diagnosis.power_on import SelfTest
from handeye.systems.sigma.protocol import AXES, COMPONENTS, NUMBERS, name_of

ARMS: Final = (1, 2)
UNDECIDED: Final = (
    "every test passes, but three kinds of faults cannot be found by any test. Line A of a wrist or hand may be "
    "stuck low: a sound line A of these parts never rises either. Line B of a wrist may be stuck high: a wrist is "
    "always busy. One of the two lowest bits of a converter may be stuck: these bits change a reading by .1 N at "
    "most"
)
_NEAR_N: Final = 0.15  # greatest error of a sound wrist, if its load is known to .1 N
_OFFSET_SPREAD_N: Final = 0.11  # greatest spread of the errors of a gauge that only has an offset


class Outcome(Protocol):
    """The result of a test."""

    @property
    def lines(self) -> Sequence[str]: ...


Result = TypeVar("Result", bound=Outcome)


class Verdict(Record, frozen=True, kw_only=True):
    """The part to which a diagnosis leads, with the reason."""

    part: str  # the faulty part; empty: none is named
    why: str
    tests: int  # used


class Found(Exception):
    """Raised when the faulty part has been found."""

    def __init__(self, part: str, why: str) -> None:
        super().__init__(part)
        self.part, self.why = part, why


class Strategy:
    """One diagnosis. `tell` is called after each test, with two values: the test as a player types it, and the lines
    of text that state the result.
    """

    def __init__(
        self, at: Technician, tell: Callable[[str, Sequence[str]], None] = lambda _, __: None
    ) -> None:
        self._at, self._tell, self._tests = at, tell, 0

    def diagnose(self) -> Verdict:
        """Run tests in the order of the paper until a faulty part is found."""
        try:
            self._bus()
            self._wrists()
            self._hands()
            for axis in AXES:
                self._axis(axis)
            self._drives()
        except Found as found:
            return Verdict(part=found.part, why=found.why, tests=self._tests)
        return Verdict(part="", why=UNDECIDED, tests=self._tests)

    def _test(self, typed: str, test: Callable[[], Result]) -> Result:
        self._tests += 1
        result = test()
        self._tell(typed, result.lines)
        return result

    # -- computer, bus, microcomputers ------------------------------------------------------------------------

    def _bus(self) -> None:
        for fault in self._test("selftest", lambda: means.self_tests(self._at)).faults:
            raise Found(part_of(fault), fault.fault)
        for number in self._test("clocks", lambda: means.clocks(self._at)).wrong:
            raise Found(
                f"microcomputer {name_of(number)}",
                "its answers take more or less time than the answers of the other microcomputers",
            )
        if self._test("strobe", lambda: means.strobe(self._at)).misread:
            raise Found(
                "computer",
                "it raises /DATA READY too late: if a microcomputer becomes free during a command, the "
                "microcomputer misreads this command",
            )

    # -- wrists and hands, while no motor moves -----------------------------------------------------------------

    def _wrists(self) -> None:
        for arm in ARMS:
            found = self._test(f"force {arm}", partial(means.forces, self._at, arm))
            part, why = wrong_force(found)
            if part:
                raise Found(part, why)

    def _hands(self) -> None:
        for arm in ARMS:
            beam = self._test(f"beam {arm}", lambda arm=arm: means.beam(self._at, arm))  # type: ignore[misc]
            if beam.free is not False or beam.rod is not True:
                raise Found(
                    f"beam of hand {arm}", "its reading is wrong without an object, or with a rod in the beam"
                )
            if beam.glass:
                raise Found(
                    f"lamp of hand {arm}",
                    "with a grey filter in the beam, the beam reads as interrupted, although the filter passes "
                    "enough light",
                )
            grip = self._test(f"grip {arm}", lambda arm=arm: means.grip(self._at, arm))  # type: ignore[misc]
            if not grip.busy:
                raise Found(f"status line B of HAND{arm}", "the line stays low while the hand closes")
            if (grip.done or 0.0) < means.SIDEWAYS_N:
                late = (grip.later or 0.0) >= means.SIDEWAYS_N
                why = (
                    "the fingers meet the block only after the hand has reported the end of its motion"
                    if late
                    else "the fingers do not close"
                )
                raise Found(f"fingers of hand {arm}", why)

    # -- motors ---------------------------------------------------------------------------------------------

    def _axis(self, axis: str) -> None:
        home = self._test(f"origin {axis}", lambda: means.origin(self._at, axis))
        self._lines_b(home)
        self._trips(axis, tripped=home.status is Status.FORCE)
        far = self._test(f"rail {axis}", lambda: means.rail(self._at, axis))
        self._lines_b(far)
        self._trips(axis, tripped=far.status is Status.FORCE)
        if home.status is not Status.FREE:
            moved = far.status is Status.RAIL
            if moved:
                raise Found(
                    f"low switch of {axis}",
                    "ORIGIN does not find this switch, but the high switch stops the motor",
                )
            raise Found(f"driver of {axis}", "the axis reaches neither switch")
        if far.status is Status.FREE and far.count == far.steps:
            raise Found(f"high switch of {axis}", "the motor makes all its steps, past the switch")
        if far.status is Status.FREE:
            raise Found(f"status line A of {axis}", "the switch stops the motor, but the line stays low")
        if not far.count:
            raise Found(f"high switch of {axis}", "the switch stops the motor before the first step")
        if far.astray:
            self._swap(axis)
        if not far.interrupt:
            raise Found(
                "interrupt wire", f"line A of {axis} is high, but the interrupt of the computer is low"
            )

    def _lines_b(self, motion: Motion) -> None:
        if not motion.busy and motion.deaf:
            raise Found(
                f"status line B of {motion.axis}",
                "the line is low, as if the motor were free, although the motor moves and does not answer",
            )

    def _trips(self, axis: str, *, tripped: bool) -> None:
        if tripped:
            part = f"accelerometer {axis[0]} of wrist {axis[1]}"
            raise Found(part, "a force stops a free move, although the wrist reads known loads correctly")

    def _drives(self) -> None:
        for axis in AXES:
            free = self._test(f"moves {axis}", lambda axis=axis: means.moves(self._at, axis))  # type: ignore[misc]
            self._trips(axis, tripped=bool(free.tripped))
            if free.losers:
                raise Found(f"driver of {axis}", "the motor loses steps at full speed")
            if self._test(f"load {axis}", lambda axis=axis: means.load(self._at, axis)).losers:  # type: ignore[misc]
                raise Found(f"driver of {axis}", f"the motor cannot move against {means.PULL_N:g} N")
        together = self._test("together", lambda: means.moves(self._at, *AXES))
        if together.losers:
            raise Found("supply", f"{' and '.join(together.losers)} lose steps when all motors move at once")

    def _swap(self, axis: str) -> None:
        """Find out which of two parts is faulty: a microcomputer, or the driver that it controls."""
        self._test(f"swap {axis}", lambda: swapped(self._at, axis))
        self._test(f"origin {axis}", lambda: means.origin(self._at, axis))
        again = self._test(f"rail {axis}", lambda: means.rail(self._at, axis))
        why = "the far switch is reached after too many pulses"
        if again.astray:
            raise Found(f"driver of {axis}", f"{why}, even with a spare microcomputer")
        raise Found(f"microcomputer {axis}", f"{why}, but not with a spare microcomputer")


class Swapped(Record, frozen=True, kw_only=True):
    """The result of replacing a microcomputer."""

    name: str

    @property
    def lines(self) -> Sequence[str]:
        return [
            f"a spare microcomputer replaces the microcomputer of {self.name}; the machine was switched off and on"
        ]


def swapped(at: Technician, name: str) -> Swapped:
    """Replace a microcomputer by a spare one."""
    at.swap(NUMBERS[name])
    return Swapped(name=name)


def part_of(test: SelfTest) -> str:
    """Return the part that a failed self-test accuses."""
    if test.part == "microcomputer":
        return f"microcomputer {name_of(test.number)}"
    if test.part == "status line":
        line = "A" if "line A" in test.fault else "B"
        return f"status line {line} of {name_of(test.number)}"
    return test.part if test.part == "computer" else f"{test.part} {test.number}"


def wrong_force(found: means.Forces) -> tuple[str, str]:
    """Find the part of a wrist that gives wrong readings for known loads. Returns this part, and the reason. Both
    texts are empty if no part reads wrongly.
    """
    arm, errors = found.arm, [*_errors(found)]
    if any(value is None for _, _, read in found.readings for value in read):
        return f"microcomputer FORCE{arm}", "it answers only some questions"
    wrong = {component for component, _, error in errors if abs(error) > _NEAR_N}
    if not wrong:
        return "", ""
    loaded = [read for _, newtons, read in found.readings if newtons]
    if all(len({round(value or 0.0, 2) for value in read}) == 1 for read in loaded) and any(map(any, loaded)):
        return (
            f"multiplexer of wrist {arm}",
            "all components give the same reading, whichever component is loaded",
        )
    if len(wrong) > 1:
        return f"converter of wrist {arm}", "the readings of more than one component are wrong"
    (component,) = wrong
    own = [error for each, _, error in errors if each == component]
    spread = max(own) - min(own)
    why = (
        "at every load, its reading is wrong by the same force"
        if spread <= _OFFSET_SPREAD_N
        else "its reading does not follow the load"
    )
    return f"gauge {COMPONENTS[component]} of wrist {arm}", why


def _errors(found: means.Forces) -> Iterator[tuple[int, float, float]]:
    """Yield, for each component of the force, three values: its number, the true load (N), and the error of the
    reading (N).
    """
    for loaded, newtons, read in found.readings:
        for component, value in enumerate(read):
            there = newtons if component == loaded else 0.0
            yield component, there, (value or 0.0) - there
