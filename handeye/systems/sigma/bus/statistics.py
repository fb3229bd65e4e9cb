"""Counts how often receivers misread commands, for different clock errors of the receivers."""

from typing import Final

from handeye.core.distributions import random_numbers
from handeye.core.record import Record
from handeye.systems.sigma.bus.layout import Layout, Place
from handeye.systems.sigma.bus.microcomputer import Microcomputer
from handeye.systems.sigma.bus.wires import Sending, Wires
from handeye.systems.sigma.firmware.device import PS
from handeye.systems.sigma.protocol import Timing

_ANOTHER: Final = Layout(places=(Place(number=1, kind="motor"),))
_AT_ONCE: Final = 10_000  # commands whose numbers are drawn together


class Rate(Record, frozen=True, kw_only=True):
    """How many random commands were sent, each to one free microcomputer, and how they were received."""

    clock: float  # greatest clock error, as a fraction
    commands: int
    whole: int  # commands that were taken as they were sent
    missed: int  # commands after whose strobe the microcomputer became free
    misread: int
    fast: float | None  # least error of a fast clock with which a receiver misread a command; None: none did
    slow: float | None  # the same for a slow clock


def error_rate(clock: float, commands: int, seed: int = 0, timing: Timing | None = None) -> Rate:
    """Send random commands to receivers that become free at random times. Each receiver's clock runs fast or slow by a
    random fraction, at most `clock`.

    The earliest time at which a receiver becomes free is one command's duration before the start of its command; the
    latest is the end of the command.
    """
    timing = timing or Timing()
    wires = Wires(_ANOTHER, timing, ())
    drawn = random_numbers(seed, f"bus errors {clock:g}")
    whole = missed = 0
    wrong: list[float] = []
    start = timing.command  # microseconds, so that no time is negative
    for first in range(0, commands, _AT_ONCE):
        count = min(_AT_ONCE, commands - first)
        clocks = drawn.uniform(-clock, clock, count)
        frees = drawn.integers(0, 2 * timing.command * PS, count)
        frames = drawn.integers(0, 256, (count, 5), dtype="uint8")
        for share, free, frame in zip(clocks.tolist(), frees.tolist(), frames, strict=True):
            sending = Sending(
                start=start, frame=frame.tobytes(), falls=timing.strobe_falls, rises=timing.strobe_rises
            )
            taken = _taken(wires, timing, sending, round(share * PS), free)
            if taken is None:
                missed += 1
            elif taken == sending.frame:
                whole += 1
            else:
                wrong.append(share)
    return Rate(
        clock=clock,
        commands=commands,
        whole=whole,
        missed=missed,
        misread=len(wrong),
        fast=min((-share for share in wrong if share < 0), default=None),
        slow=min((share for share in wrong if share > 0), default=None),
    )


def _taken(wires: Wires, timing: Timing, sending: Sending, ppm: int, free: int) -> bytes | None:
    """Return the bytes that a receiver takes if it becomes free at the time `free` (ps), or None if the receiver takes
    no bytes.
    """
    node = Microcomputer(
        _ANOTHER.places[0], timing, answers_to=256, ppm=ppm, phase=free, dead=False
    )  # a microcomputer with an unused number, so that it acts on nothing
    passed = node.listen(free, (sending,), wires, quiet=True)
    if passed:
        return passed[0].frame
    if node.memory.noticed is None:
        return None
    due = node.due
    assert due is not None
    taken = node.receive(due, (sending,), (), wires)
    assert taken is not None
    return taken.frame
