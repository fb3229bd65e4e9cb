"""Computes the levels of the lines on each segment. Receivers can sample the lines at any time.

The whole wave of a command or an answer is determined when it begins. Times are in picoseconds.
"""

from collections.abc import Iterable, Sequence
from typing import Final

from handeye.core.record import Record
from handeye.systems.sigma.bus.faults import BusDefect
from handeye.systems.sigma.bus.layout import Layout
from handeye.systems.sigma.firmware.device import PS, Crystal
from handeye.systems.sigma.protocol import Timing

OPEN: Final = 0xFF  # what data lines read while nothing drives them


class Sending(Record, frozen=True, kw_only=True):
    """A command that the central computer puts on the lines."""

    start: int  # microseconds
    frame: bytes
    falls: int  # microseconds from the start to the falling edge of /DATA READY
    rises: int


class Speech(Record, frozen=True, kw_only=True):
    """An answer that a microcomputer puts on the lines."""

    number: int  # number of the microcomputer that answers
    segment: int
    frame: bytes
    begin: int  # ps
    ppm: int  # error of its clock

    def lows(self, timing: Timing) -> list[tuple[int, int]]:
        """Return an interval for each byte of the answer: its beginning and its end (ps). During the interval, the
        byte is on the lines and /ANSWER READY is low.
        """
        clock = Crystal(self.ppm)
        starts = [self.begin + clock.micros(timing.answer * byte) for byte in range(len(self.frame))]
        return [(start, start + clock.micros(timing.answer_low)) for start in starts]


class Wires:
    """The lines of a bus, with injected faults."""

    def __init__(self, layout: Layout, timing: Timing, defects: Sequence[BusDefect]) -> None:
        self.layout, self.timing = layout, timing
        self.settle = timing.settle + sum(d.value for d in defects if d.kind == "slow-lines")
        self.strobe_rises = next((d.value for d in defects if d.kind == "long-strobe"), timing.strobe_rises)
        segments = range(len(layout.behind))
        low, high = (
            [sum(1 << d.value for d in defects if (d.kind, d.where) == (kind, s)) for s in segments]
            for kind in ("stuck-low", "stuck-high")
        )
        self._stuck = [*zip(low, high, strict=True)]
        dead = {d.where for d in defects if d.kind == "dead-interface"}
        self.cut_off = [bool(dead.intersection(layout.way(segment))) for segment in segments]
        self._clean = [
            not self.cut_off[s] and not any(any(self._stuck[w]) for w in layout.way(s)) for s in segments
        ]
        self._rigid = {d.where for d in defects if d.kind == "no-turn"}

    def strobe(self, sending: Sending) -> tuple[int, int]:
        """Return the interval in which /DATA READY is low for a command: its beginning and its end (ps)."""
        return (sending.start + sending.falls) * PS, (sending.start + sending.rises) * PS

    def whole(self, sending: Sending, segment: int, first: int, last: int) -> bool:
        """Samples are evenly spaced from the time `first` to the time `last` (ps). Return True if they read each byte
        of a command as it was sent.
        """
        begin, slot = (sending.start + self.settle) * PS, self.timing.slot * PS
        end = begin + len(sending.frame) * slot
        return self._clean[segment] and begin <= first < begin + slot and end - slot <= last < end

    def data(self, segment: int, at: int, sent: Iterable[Sending], speeches: Iterable[Speech] = ()) -> int:
        """Return the byte that a microcomputer on a segment reads at the time `at`."""
        value, then = OPEN, at - self.settle * PS
        for sending in sent:
            slot = (then - sending.start * PS) // (self.timing.slot * PS)
            if 0 <= slot < len(sending.frame):
                value = sending.frame[slot]
        for way in self.layout.way(segment):
            value = self._through(way, value)
        for speech in speeches:
            if speech.segment == segment and (byte := self._spoken(speech, at)) is not None:
                value &= byte
        return value

    def heard(self, at: int, speeches: Iterable[Speech]) -> int:
        """Return the byte that the central computer reads at the time `at`."""
        value = OPEN
        for speech in speeches:
            byte = self._spoken(speech, at - self.settle * PS)
            if byte is None:
                continue
            for segment in reversed(self.layout.way(speech.segment)):
                byte = self._through(segment, byte)
                if segment in self._rigid and segment:
                    byte = OPEN
            value &= byte
        return self._through(0, value)

    def turned(self, speech: Speech) -> tuple[int, ...]:
        """Return the segments whose regenerators change direction for an answer."""
        return tuple(s for s in self.layout.way(speech.segment) if s and s not in self._rigid)

    def answers(self, speeches: Iterable[Speech]) -> list[tuple[int, int]]:
        """Return the intervals in which /ANSWER READY is low at the central computer, the earliest first. Each
        interval is a beginning and an end (ps).
        """
        lows = sorted(low for speech in speeches for low in speech.lows(self.timing))
        joined: list[tuple[int, int]] = []
        for start, end in lows:
            if joined and start <= joined[-1][1]:
                joined[-1] = joined[-1][0], max(end, joined[-1][1])
            else:
                joined.append((start, end))
        return joined

    def _spoken(self, speech: Speech, at: int) -> int | None:
        """Return the byte that a microcomputer drives onto the lines at the time `at`, or None if the microcomputer
        drives no byte.
        """
        for byte, (start, end) in zip(speech.frame, speech.lows(self.timing), strict=True):
            if start <= at < end:
                return byte
        return None

    def _through(self, segment: int, value: int) -> int:
        low, high = self._stuck[segment]
        return value & ~low | high
