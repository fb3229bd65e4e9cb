"""The self-tests at power-on, in the order of the paper. These tests use only the bus interface.

The central computer is tested first, then the segments of the bus, then each microcomputer. If the interface of a
segment is faulty, the tests of all microcomputers behind that interface fail. If a microcomputer is faulty, only its
own test fails.
"""

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Literal

from handeye.core.record import Record
from handeye.ports.microbus import BusFault, Command, MicrobusPort, Status
from handeye.systems.sigma.bus.layout import Layout
from handeye.systems.sigma.protocol import ANSWERS, Op, echo, name_of, self_test

PATTERNS: Final = (b"\x55\xaa\x33", b"\xaa\x55\xcc")
"""Test patterns for ECHO. They drive each data line both low and high, and neighbouring bytes differ."""
DEAD: Final = (
    "no microcomputer on this segment answers: the interface of the segment is dead, or one data line, which "
    "is low in the addresses of all these microcomputers, is stuck high"
)
_ALL: Final = 0xFF

Part = Literal["computer", "segment", "regenerator", "microcomputer", "status line"]


class SelfTest(Record, frozen=True, kw_only=True):
    """The result of one test."""

    part: Part
    number: int  # number of the segment or microcomputer
    fault: str = ""  # what is wrong; empty: nothing


@dataclass(frozen=True, slots=True)
class _Heard:
    """The answers of one microcomputer. An answer that did not arrive is None."""

    well: bytes | None
    echoes: tuple[bytes | None, ...]
    busy: frozenset[int]  # microcomputers whose line B rose meanwhile

    @property
    def silent(self) -> bool:
        return self.well is None and not any(self.echoes)

    @property
    def right(self) -> bool:
        return self.well == b"\0" and self.echoes == PATTERNS

    @property
    def open(self) -> bool:
        """True if strobes arrived, but no microcomputer drove the data lines."""
        answers = [answer for answer in (self.well, *self.echoes) if answer is not None]
        return bool(answers) and all(byte == _ALL for answer in answers for byte in answer)


def power_on(bus: MicrobusPort, layout: Layout) -> list[SelfTest]:
    """Test everything that is connected to a bus. Microcomputers behind a faulty segment are not judged."""
    numbers = [place.number for place in layout.places]
    at_rest = {number: bus.status(number) for number in numbers}
    heard = {number: _heard(bus, number, numbers) for number in numbers}
    out = [SelfTest(part="computer", number=0)]
    lost: set[int] = set()
    failed: set[int] = set()
    for segment, members in enumerate(layout.segments):
        found = None
        if failed.isdisjoint(layout.way(segment)):
            found = _segment(segment, {number: heard[number] for number in members})
            out.append(found)
        if found is None or found.fault:
            failed.add(segment)
            lost.update(members)
    scanning = {place.number for place in layout.places if place.kind == "force"}
    out += [_microcomputer(number, heard, scanning) for number in numbers if number not in lost]
    wrong = {test.number for test in out if test.part == "microcomputer" and test.fault}
    out += _status_lines({n: status for n, status in at_rest.items() if n not in wrong}, scanning)
    return out


def _heard(bus: MicrobusPort, number: int, numbers: Sequence[int]) -> _Heard:
    busy: set[int] = set()
    before = {other for other in numbers if bus.status(other) is Status.BUSY}

    def asked(command: Command) -> bytes | None:
        bus.begin(command, answer=ANSWERS[Op(command.op)])
        while not bus.free:
            event = bus.next_event
            bus.wait(bus.now + 1 if event is None else max(bus.now + 1, event))
            busy.update(other for other in numbers if bus.status(other) is Status.BUSY)
        try:
            return bus.answer()
        except BusFault:
            return None

    well = asked(self_test(number))
    echoes = tuple(asked(echo(number, pattern)) for pattern in PATTERNS)
    return _Heard(well, echoes, frozenset(busy - before))


def _segment(segment: int, heard: Mapping[int, _Heard]) -> SelfTest:
    if len(heard) < 2 or any(one.right for one in heard.values()):  # one alone cannot blame its segment
        return SelfTest(part="segment", number=segment)
    if all(one.silent for one in heard.values()):
        return SelfTest(part="segment", number=segment, fault=DEAD)
    if all(one.open for one in heard.values() if not one.silent):
        return SelfTest(
            part="regenerator",
            number=segment,
            fault="it does not reverse its direction: strobes of answers arrive, but no data",
        )
    stuck = _stuck([one for one in heard.values() if not one.silent])
    return SelfTest(part="segment", number=segment, fault=stuck)


def _stuck(heard: Sequence[_Heard]) -> str:
    """Describe the faulty data line of a segment in words."""
    echoed = [byte for one in heard for answer in one.echoes if answer for byte in answer]
    wells = [byte for one in heard if one.well for byte in one.well]
    high = _ALL
    for byte in (*echoed, *wells):
        high &= byte
    low = _ALL
    for byte in echoed:
        low &= ~byte
    for bit in range(8):
        if high >> bit & 1:
            return f"data line {bit} is stuck high"
        if echoed and low >> bit & 1:
            return f"data line {bit} is stuck low"
    if not echoed:
        return "data line 7 is stuck low"  # only ECHO needs this line
    return "its data lines are faulty: some bytes arrive and others do not"


def _microcomputer(number: int, heard: Mapping[int, _Heard], scanning: Container[int]) -> SelfTest:
    one = heard[number]

    def takes(stranger: int, other: int) -> bool:
        """The microcomputer `stranger` is silent at its own number. Return True if it answers to the number of the
        microcomputer `other` instead. The usual sign is that both microcomputers become busy together. The
        microcomputer of a wrist is always busy; if `stranger` belongs to a wrist, the sign is that it disturbs the
        answers of `other`.
        """
        theirs = heard[other]
        seen = not theirs.right if stranger in scanning else stranger in theirs.busy
        return other != stranger and heard[stranger].silent and not theirs.silent and seen

    fault = ""
    if one.silent:
        taken = [other for other in heard if takes(number, other)]
        spare = f"it answers to {name_of(taken[0])}'s number instead of its own" if taken else ""
        fault = spare or "it is dead: it does not answer"
    elif one.right or any(takes(stranger, number) for stranger in heard):
        pass
    elif one.well not in (None, b"\0"):
        fault = "its self-test fails"
    else:
        fault = "its clock is wrong: instead of the right byte, it reads the byte before or after"
    return SelfTest(part="microcomputer", number=number, fault=fault)


def _status_lines(at_rest: Mapping[int, Status], scanning: Container[int]) -> Iterator[SelfTest]:
    for number, status in at_rest.items():
        usual = Status.BUSY if number in scanning else Status.FREE
        if status.aborted:
            yield SelfTest(
                part="status line", number=number, fault="line A is high, although no motion was aborted"
            )
        elif status is not usual:
            level = "high" if status is Status.BUSY else "low"
            yield SelfTest(part="status line", number=number, fault=f"line B is {level} at rest")


def told(tests: Sequence[SelfTest]) -> list[str]:
    """Return the results as lines of text: the faults, or a statement that there are none."""
    out = [f"{_name(test)}: {test.fault}" for test in tests if test.fault]
    return out or ["no fault found in the computer, segments, microcomputers and status lines"]


def _name(test: SelfTest) -> str:
    if test.part in ("microcomputer", "status line"):
        return (
            f"{test.part} of {name_of(test.number)}" if test.part == "status line" else name_of(test.number)
        )
    return test.part if test.part == "computer" else f"{test.part} {test.number}"
