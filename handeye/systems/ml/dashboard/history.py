"""The recorded tables of a run: the value of each word in each cycle. The recorded tables can be written to a file and
read again.
"""

import gzip
import zlib
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated, Final

import msgspec

from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.systems.ml.arithmetic import HIGHEST, LOWEST
from handeye.systems.ml.dashboard.layout import Segment, line_labels, segments
from handeye.systems.ml.dashboard.tape import Changes
from handeye.systems.ml.level import Side

_EXPANDED: Final = 500_000_000  # bytes
_BAD: Final = "is not a recording of the machine's tables"


class Head(Record, frozen=True, kw_only=True):
    """The beginning of a recording of tables."""

    program: str
    sides: Annotated[tuple[Side, ...], msgspec.Meta(min_length=1, max_length=2)]
    cycles: Annotated[int, msgspec.Meta(ge=0, le=10**9)]  # number of cycles that have passed
    statements: Mapping[int, str] = {}  # statements of the program, by their numbers


@dataclass
class Course:
    """The values of one word. From cycle `cycles[n]` on, the word has the value `values[n]`."""

    cycles: list[int] = field(default_factory=list)
    values: list[int] = field(default_factory=list)

    def at(self, cycle: int) -> int:
        """Return the value at the end of a cycle."""
        found = bisect_right(self.cycles, cycle)
        return self.values[found - 1] if found else 0

    def changed(self, cycle: int) -> bool:
        """Return True if the word was changed in a cycle. The word's first value, in cycle 0, does not count as a
        change.
        """
        found = bisect_right(self.cycles, cycle)
        return found > 0 < cycle == self.cycles[found - 1]

    @property
    def changes(self) -> bool:
        """True if the word has been changed in some cycle."""
        return self.cycles[-1] > 0


class History:
    """All tables at all cycles. `courses` has no entry for a word that was 0 at all times."""

    def __init__(self, head: Head, courses: Mapping[int, Course]) -> None:
        self.head, self.courses = head, courses
        self.segments = segments(head.sides)

    @property
    def last(self) -> int:
        """The number of the last cycle in the history. This cycle is not complete: it has only the changes that
        statements have made since the cycle before it.
        """
        return self.head.cycles

    def find(self, table: str, side: str = "") -> Segment:
        """Return a table of an arm. Raises BadFile if the arm has no table with this name."""
        for segment in self.segments:
            if segment.table == table and segment.side in ("", side or self.head.sides[0]):
                return segment
        raise BadFile(f"{self.head.program} has no table {table} of the {side} arm")

    def value(self, number: int, cycle: int) -> int:
        """Return a word at the end of a cycle."""
        course = self.courses.get(number)
        return 0 if course is None else course.at(cycle)

    def changed(self, number: int, cycle: int) -> bool:
        """Return True if a word was changed in a cycle."""
        course = self.courses.get(number)
        return course is not None and course.changed(cycle)

    def used(self, segment: Segment) -> list[int]:
        """Return those lines of a table that are connected to a device or that change. If no line of the table is
        connected to a device, return each line that has a word other than 0 in any cycle.
        """
        labels = line_labels(segment.side, segment.table)
        return sorted(
            {*labels}
            | {
                segment.line_word(number)[0]
                for number, course in self.courses.items()
                if segment.base <= number < segment.base + segment.size and (not labels or course.changes)
            }
        )


def history(head: Head, changes: Iterable[Changes]) -> History:
    """Build a history from changes."""
    courses: dict[int, Course] = {}
    for cycle, number, value in (row for some in changes for row in some.tolist()):
        course = courses.get(number)
        if course is None:
            course = courses[number] = Course()
        if course.cycles and course.cycles[-1] == cycle:
            course.values[-1] = value
        else:
            course.cycles.append(cycle)
            course.values.append(value)
    return History(head, dict(sorted(courses.items())))


# -- files --------------------------------------------------------------------------------------------


def packed(done: History) -> bytes:
    """Return a history as a compressed file.

    The file begins with the length of the head and the head itself, in JSON. Then the file has four kinds of numbers
    for each word. The first number says how many words without a course were skipped before this word, and the second
    how often this word changes. The others give the cycles from each change to the next, and the increase of the value
    at each change. Integers are written with seven bits in each byte, the lowest bits first.
    """
    head = msgspec.json.encode(done.head)
    stream = bytearray(_integers([len(head)]) + head)
    last = -1
    for number, course in done.courses.items():
        gaps = [b - a for a, b in zip([0, *course.cycles], course.cycles, strict=False)]
        steps = [b - a for a, b in zip([0, *course.values], course.values, strict=False)]
        folded = [2 * step if step >= 0 else -2 * step - 1 for step in steps]
        stream += _integers([number - last - 1, len(gaps), *gaps, *folded])
        last = number
    return gzip.compress(bytes(stream), mtime=0)


def unpacked(data: bytes, name: str) -> History:
    """Read a history from a compressed file. Raises BadFile if the file is not a valid history."""
    reader = zlib.decompressobj(wbits=31)
    try:
        stream = reader.decompress(data, _EXPANDED)
        if not reader.eof:
            raise BadFile(f"{name} {_BAD}")
        read = _Reader(stream)
        head = msgspec.json.decode(read.take(next(read)), type=Head)
        sizes = segments(head.sides)
        most, last = sizes[-1].base + sizes[-1].size, -1
        courses: dict[int, Course] = {}
        for gap in read:
            last += 1 + gap
            count = next(read)
            cycles, values = _sums(read, count), _sums(read, count, folded=True)
            if last >= most or not count or cycles[-1] > head.cycles or not _words(values):
                raise BadFile(f"{name} {_BAD}")
            courses[last] = Course(cycles, values)
    except (zlib.error, StopIteration, msgspec.DecodeError, RecursionError):
        raise BadFile(f"{name} {_BAD}") from None
    return History(head, courses)


def _words(values: Sequence[int]) -> bool:
    return min(values) >= LOWEST and max(values) <= HIGHEST


def _integers(numbers: Iterable[int]) -> bytes:
    out = bytearray()
    for number in numbers:
        while number > 0x7F:
            out.append(number & 0x7F | 0x80)
            number >>= 7
        out.append(number)
    return bytes(out)


class _Reader(Iterator[int]):
    """Reads integers."""

    def __init__(self, stream: bytes) -> None:
        self._stream, self._at = stream, 0

    def __next__(self) -> int:
        number, shift = 0, 0
        while self._at < len(self._stream):
            byte = self._stream[self._at]
            self._at += 1
            number |= (byte & 0x7F) << shift
            if byte < 0x80:
                return number
            shift += 7
            if shift > 35:
                break
        raise StopIteration

    def take(self, length: int) -> bytes:
        self._at += length
        return self._stream[self._at - length : self._at]


def _sums(read: _Reader, count: int, *, folded: bool = False) -> list[int]:
    """Return the running sums of the next `count` numbers. If `folded` is True, odd numbers stand for negative
    numbers.
    """
    sums, total = [], 0
    for _ in range(count):
        number = next(read)
        total += (number >> 1 ^ -(number & 1)) if folded else number
        sums.append(total)
    return sums
