"""The tests of a diagnosis. Each test sends commands and questions over the bus, and returns what it has measured.

A test may use the interface of the bus and the manual actions of a technician. A test uses no knowledge of the fault.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median
from typing import Final, Protocol

from handeye.core.plain_text import counted
from handeye.ports.microbus import BusFault, Command, MicrobusPort, Status
from handeye.systems.sigma import protocol
from handeye.systems.sigma.bus.layout import Layout
from handeye.systems.sigma.diagnosis.power_on import SelfTest, power_on, told
from handeye.systems.sigma.protocol import ANSWERS, COMPONENTS, FORCE_STEP_N, NUMBERS, Op, name_of, signed

TRAVEL: Final = {"X": 16_000, "Y": 10_667, "Z": 5_333}  # steps: the travels in the machine's drawing
FREE_MOVE: Final = {"X": 6_000, "Y": 5_000, "Z": 3_500}  # steps at full speed
LOADS: Final = (0.0, 17.05, 34.1)  # N: between them, each bit of the converter is 0 and 1
GREY: Final = 0.7  # fraction of the light that passes a grey filter
PULL_N: Final = 120.0  # force of the spring balance; a sound motor holds 200 N at low speed
OFF_PERCENT: Final = 3.5  # the least error of a wrong clock
SIDEWAYS_N: Final = 3.0  # least push of fingers that close on the block
_SLOW: Final = 10.0  # mm/s
_TOO_FAR: Final = 1.25  # length of the move, as a multiple of the travel
_CREEP: Final = 800  # steps
_OFF_STEPS: Final = 40  # greatest distance of a switch from its place in the drawing
_LONG: Final = 200_000_000  # microseconds
_OWN: Final = 355.0  # microseconds of an answer time that depend on the clock of the microcomputer
_REPEATS: Final = 5
_COUNT: Final = 0x1234
_MISREAD: Final = 0x02FF  # the count of a late riser that has taken the wrong command
_RESTED: Final = 2_500  # microseconds at rest after which a motor turns round without delay
_LATE: Final = range(16, 33, 2)  # microseconds after the beginning of a command


class Technician(Protocol):
    """The means of a technician: the bus of the machine, and actions by hand."""

    layout: Layout

    @property
    def bus(self) -> MicrobusPort:
        """The interface of the bus."""

    def swap(self, number: int) -> None: ...
    def press(self, arm: int, component: str, newtons: float) -> None: ...
    def pull(self, axis: str, newtons: float) -> None: ...
    def shade(self, arm: int, passes: float) -> None: ...
    def block(self, arm: int, *, there: bool) -> None: ...


@dataclass(frozen=True, slots=True)
class SelfTests:
    """The faults that the self-tests at power-on have found."""

    faults: tuple[SelfTest, ...]

    @property
    def lines(self) -> Sequence[str]:
        return told(self.faults)


def self_tests(at: Technician) -> SelfTests:
    """Run the power-on self-tests: computer, segments, microcomputers, and status lines at rest."""
    return SelfTests(tuple(test for test in power_on(at.bus, at.layout) if test.fault))


@dataclass(frozen=True, slots=True)
class Clocks:
    """The clock error of each microcomputer: the percentage by which the clock is slower than usual. The test computes
    this error from the times of the microcomputer's answers. The value is None for a microcomputer that does not
    answer.
    """

    slow: dict[int, float | None]

    @property
    def wrong(self) -> list[int]:
        """Numbers of the microcomputers whose clock errors are too great."""
        return [number for number, off in self.slow.items() if off is not None and abs(off) > OFF_PERCENT]

    @property
    def lines(self) -> Sequence[str]:
        each = [f"{name_of(n)} {'-' if off is None else f'{off:+.1f}'}" for n, off in self.slow.items()]
        return [f"how slow each clock is, in percent: {', '.join(each)}"]


def clocks(at: Technician) -> Clocks:
    """Measure the time that each microcomputer takes to answer."""
    taken = {place.number: _answer_time(at.bus, place.number) for place in at.layout.places}
    known = [each for each in taken.values() if each is not None]
    usual = median(known) if known else 0.0
    return Clocks({n: None if each is None else (each - usual) / _OWN * 100 for n, each in taken.items()})


def _answer_time(bus: MicrobusPort, number: int) -> float | None:
    """Return the time from a question for three bytes until the bus is free (microseconds), or None if there
    was no proper answer."""
    taken = 0
    for _ in range(_REPEATS):
        begun = bus.now
        bus.begin(protocol.echo(number, b"\x55\xaa\x33"), answer=3)
        while not bus.free:
            event = bus.next_event
            bus.wait(bus.now + 1 if event is None else max(bus.now + 1, event))
        try:
            bus.answer()
        except BusFault:
            return None
        taken += bus.now - begun
        pause(bus, 997)  # the next try begins in another phase of the polls
    return taken / _REPEATS


@dataclass(frozen=True, slots=True)
class Strobe:
    """The result of a test in which a microcomputer becomes free in the middle of a command. `misread` counts the
    tries in which the microcomputer took a command that was never sent.
    """

    tries: int
    misread: int

    @property
    def lines(self) -> Sequence[str]:
        if self.misread:
            often = f"in {self.misread} of {counted(self.tries, 'try')}"
            return [
                f"{often}, a microcomputer became free in the middle of a command, and obeyed a command that was never "
                "sent"
            ]
        return [
            f"in {counted(self.tries, 'try')}, no microcomputer that became free in the middle of a command misread "
            "the command"
        ]


def strobe(at: Technician) -> Strobe:
    """Let the microcomputer of Z2 become free in the middle of a command to X1, at several moments. The later
    bytes of that command read like a command to Z2."""
    bus, late = at.bus, NUMBERS["Z2"]
    frame = bytes((NUMBERS["X1"], Op.SET_POSITION, Op.SET_POSITION, 1, 2))
    assert frame[1] == late
    steps, misread = 8, 0
    bus.send(protocol.move("Z2", steps))
    begun = bus.now
    bus.wait_free(late, _LONG)
    takes = bus.now - begun
    for after in _LATE:
        steps = -steps
        bus.send(protocol.set_position("Z2", _COUNT))
        pause(bus, _RESTED)
        bus.send(protocol.move("Z2", steps))
        pause(bus, takes - after)
        bus.send(Command.of(frame))
        pause(bus, 1_000)
        bus.wait_free(late, _LONG)
        misread += _count(bus, "Z2") == _MISREAD
    return Strobe(len(_LATE), misread)


@dataclass(frozen=True, slots=True)
class Motion:
    """A motion, as the status lines and the count show it."""

    axis: str
    steps: int  # steps that the command asked for; 0: ORIGIN
    busy: bool  # True: its status was 0-1 on the way
    deaf: bool  # True: it did not answer afterwards, though its status was not 0-1
    status: Status  # status at the end
    interrupt: bool
    count: int | None
    at_abort: int | None = None  # the count at which a switch or a force stopped the motor

    @property
    def astray(self) -> bool:
        """True if the far switch stopped the motion at a count that differs from the count in the drawing."""
        return self.at_abort is not None and abs(self.at_abort - TRAVEL[self.axis[0]]) > _OFF_STEPS

    @property
    def lines(self) -> Sequence[str]:
        asked = f"{self.axis} moves by {counted(self.steps, 'step')}" if self.steps else f"ORIGIN {self.axis}"
        while_ = "" if self.busy else "; the status was never busy"
        deaf = ", although the axis was still moving" if self.deaf else ""
        lines = f"{self.status >> 1}-{self.status & 1}"
        stop = "" if self.at_abort is None else f", stopped at {self.at_abort}"
        level = "high" if self.interrupt else "low"
        return [f"{asked}: status {lines}, interrupt {level}, count {self.count}{stop}{while_}{deaf}"]


def origin(at: Technician, axis: str) -> Motion:
    """Move an axis to the low end of its rail with ORIGIN."""
    return _motion(at.bus, axis, protocol.origin(axis), 0)


def rail(at: Technician, axis: str) -> Motion:
    """Move an axis to the high end of its rail, and beyond it if nothing stops the motor."""
    steps = round(_TOO_FAR * TRAVEL[axis[0]])
    found = _motion(at.bus, axis, protocol.move(axis, steps), steps)
    if found.status is Status.RAIL and found.count:
        _motion(at.bus, axis, protocol.move(axis, -TRAVEL[axis[0]] // 2), 0)
    return found


def _motion(bus: MicrobusPort, axis: str, command: Command, steps: int) -> Motion:
    number = NUMBERS[axis]
    bus.send(command)
    pause(bus, 2_000)
    busy = bus.status(number) is Status.BUSY
    status = bus.wait_free(number, _LONG)
    interrupt = bus.interrupt
    count, deaf = _count(bus, axis), False
    while count is None and not deaf:
        pause(bus, _LONG)
        count, deaf = _count(bus, axis), True
    stopped = _count(bus, axis, at_abort=True) if status.aborted else None
    return Motion(axis, steps, busy, deaf and count is not None, status, interrupt, count, stopped)


@dataclass(frozen=True, slots=True)
class Lost:
    """The steps that motors have lost, and the axes that a force has stopped. The lost steps are computed from the
    count at which the low switch acts.
    """

    what: str
    steps: dict[str, int | None]  # None: the switch was not found
    tripped: tuple[str, ...]

    @property
    def losers(self) -> list[str]:
        """Axes that have lost steps, or that have not reached their switch."""
        return [axis for axis, lost in self.steps.items() if lost != 0]

    @property
    def lines(self) -> Sequence[str]:
        each = [f"{axis} {'no switch' if lost is None else lost}" for axis, lost in self.steps.items()]
        force = f"; stopped by a force: {', '.join(self.tripped)}" if self.tripped else ""
        return [f"{self.what}: steps lost: {', '.join(each)}{force}"]


def moves(at: Technician, *axes: str) -> Lost:
    """Move the axes out together at full speed, and then move them back slowly. The low switches show how many
    steps the motors lost on the way.
    """
    bus = at.bus
    for axis in axes:
        origin(at, axis)
    for axis in axes:
        bus.send(protocol.move(axis, FREE_MOVE[axis[0]]))
    tripped = tuple(axis for axis in axes if bus.wait_free(NUMBERS[axis], _LONG) is Status.FORCE)
    what = "at full speed" if len(axes) == 1 else "all axes together at full speed"
    return Lost(what, {axis: _lost(bus, axis) for axis in axes}, tripped)


def load(at: Technician, axis: str) -> Lost:
    """Move an axis slowly against a spring balance."""
    bus = at.bus
    origin(at, axis)
    at.pull(axis, PULL_N)
    bus.send(protocol.move_slow(axis, _CREEP, _SLOW))
    tripped = bus.wait_free(NUMBERS[axis], _LONG) is Status.FORCE
    at.pull(axis, 0.0)
    return Lost(f"against {PULL_N:g} N", {axis: _lost(bus, axis)}, (axis,) if tripped else ())


def _lost(bus: MicrobusPort, axis: str) -> int | None:
    """Return the number of steps by which an axis lags behind its count, or None if this number cannot be measured. If
    no steps were lost, the low switch acts at a count of -1."""
    here = _count(bus, axis)
    if here is None:
        return None
    bus.send(protocol.move_slow(axis, -(abs(here) + TRAVEL[axis[0]]), _SLOW * 3))
    if bus.wait_free(NUMBERS[axis], _LONG) is not Status.RAIL:
        return None
    found = _count(bus, axis, at_abort=True)
    return None if found is None else found + 1


@dataclass(frozen=True, slots=True)
class Forces:
    """What a wrist reads under known loads: for each load, the loaded component, the load, and all three
    readings (N). A reading is None if there was no answer."""

    arm: int
    readings: tuple[tuple[int, float, tuple[float | None, ...]], ...]

    @property
    def lines(self) -> Sequence[str]:
        out = []
        for component, name in enumerate(COMPONENTS):
            each = [
                f"{newtons:g} N reads {' '.join('-' if v is None else f'{v:.2f}' for v in read)}"
                for loaded, newtons, read in self.readings
                if loaded == component
            ]
            out.append(f"wrist {self.arm}, load along {name}: {', '.join(each)}")
        return out


def forces(at: Technician, arm: int) -> Forces:
    """Apply known forces to a wrist, along each of its axes, and read the wrist."""
    readings = []
    for component, name in enumerate(COMPONENTS):
        for newtons in LOADS:
            at.press(arm, name, newtons)
            pause(at.bus, 2_000)
            readings.append((component, newtons, tuple(_force(at.bus, arm, each) for each in COMPONENTS)))
        at.press(arm, name, 0.0)
    return Forces(arm, tuple(readings))


@dataclass(frozen=True, slots=True)
class Beam:
    """Three readings of a light beam: with nothing in it, with a rod in it, and with a grey filter in it. A reading is
    True if the beam appears to be interrupted. A reading is None if there was no answer.
    """

    arm: int
    free: bool | None
    rod: bool | None
    glass: bool | None

    @property
    def lines(self) -> Sequence[str]:
        words = {True: "broken", False: "free", None: "no answer"}
        return [
            f"beam {self.arm} with nothing in it: {words[self.free]}; with a rod: {words[self.rod]}; with a grey "
            f"filter: {words[self.glass]}"
        ]


def beam(at: Technician, arm: int) -> Beam:
    """Read a light beam three times: with nothing in the beam, with a rod, and with a grey filter."""
    found: list[bool | None] = []
    for passes in (1.0, 0.0, GREY):
        at.shade(arm, passes)
        answer = asked(at.bus, protocol.beam(arm))
        found.append(None if answer is None else bool(answer[0]))
    at.shade(arm, 1.0)
    return Beam(arm, *found)


@dataclass(frozen=True, slots=True)
class Grip:
    """A hand that has closed on a block that was not midway between the fingers. The push on the hand's wrist (N) was
    read twice: when the hand reported that it was done, and later.
    """

    arm: int
    busy: bool
    done: float | None
    later: float | None

    @property
    def lines(self) -> Sequence[str]:
        each = ["no answer" if value is None else f"{value:.2f} N" for value in (self.done, self.later)]
        busy = "" if self.busy else "; the status was never busy"
        return [
            f"hand {self.arm} closes: sideways force {each[0]} at the end of the motion, {each[1]} a second later{busy}"
        ]


def grip(at: Technician, arm: int) -> Grip:
    """Close a hand on a block that is not midway between the fingers."""
    bus, number = at.bus, NUMBERS[f"HAND{arm}"]
    at.block(arm, there=True)
    bus.send(protocol.actuate(arm, "HAND", 1))
    pause(bus, 2_000)
    busy = bus.status(number) is Status.BUSY
    bus.wait_free(number, 1_000_000)
    done = _force(bus, arm, "Y")
    pause(bus, 1_000_000)
    later = _force(bus, arm, "Y")
    bus.send(protocol.actuate(arm, "HAND", 0))
    pause(bus, 1_000_000)
    at.block(arm, there=False)
    return Grip(arm, busy, done, later)


def pause(bus: MicrobusPort, microseconds: int) -> None:
    """Let `microseconds` pass, even if the bus reports changes meanwhile."""
    end = bus.now + microseconds
    while bus.now < end:
        bus.wait(end)


def _count(bus: MicrobusPort, axis: str, *, at_abort: bool = False) -> int | None:
    answer = asked(bus, protocol.position(axis, at_abort=at_abort))
    return None if answer is None else signed(answer)


def _force(bus: MicrobusPort, arm: int, component: str) -> float | None:
    answer = asked(bus, protocol.force(arm, component))
    return None if answer is None else signed(answer) * FORCE_STEP_N


def asked(bus: MicrobusPort, command: Command) -> bytes | None:
    """Ask a question, and return the answer, or None if the answer was not complete."""
    try:
        return bus.ask(command, ANSWERS[Op(command.op)])
    except BusFault:
        return None
