"""Records the words that change in the tables of a running machine, cycle by cycle."""

import zlib
from abc import ABC, abstractmethod
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import compress, count
from operator import ne
from typing import Annotated, Any, Final

import msgspec
import numpy as np
from msgspec.structs import astuple
from numpy.typing import NDArray

from handeye.core.errors import BadFile
from handeye.core.mutable_records import MutableRecord
from handeye.core.record import Record
from handeye.systems.ml.background.interpreter import Interpreter
from handeye.systems.ml.background.program import StoredProgram
from handeye.systems.ml.background.views import (
    CommandCodes,
    ErrorTexts,
    HostLink,
    RecentPoints,
    SessionLog,
    TaskTable,
    TraceBuffer,
)
from handeye.systems.ml.dashboard.layout import Segment, segments
from handeye.systems.ml.level import Side, View
from handeye.systems.ml.realtime.machine import Machine

BLOCK: Final = 1 << 16  # bytes of a block when it is compressed
_MOST: Final = 1 << 24  # bytes of a block that is read from a file
_LINES: Final = ("MT", "ST", "CY", "AR")  # tables that change in most cycles, kept as lists of records
_WORDS: Final = ("AI", "AO", "DI", "DO", "PI", "CA")  # such tables that are kept as lists of words
_SHARED: Final = ("TM",)
_EVENTS: Final = ("FE", "GO", "EM", "SF")  # tables that change in some cycles

Changes = NDArray[np.int32]
"""Changed words, shape (n, 3): each row has the cycle, the number of the word and its value. Several changes of one
word are in the order in which they happened. Cycles count from 0. A change that a statement makes belongs to the cycle
after the statement.
"""


class Tape(MutableRecord):
    """The changes of all tables since the beginning of the run."""

    blocks: tuple[bytes, ...] = ()  # compressed
    open: Annotated[bytes, msgspec.Meta(max_length=_MOST)] = (
        b""  # changes of the last block, to which more are added
    )


def changes_of(tape: Tape) -> Iterator[Changes]:
    """Yield the changes on a tape. Raises BadFile if the tape cannot be read."""
    yield from map(_expanded, tape.blocks)
    yield _triples(tape.open)


def _compressed(changes: Changes) -> bytes:
    """Compress changes. The changes are sorted by word, and each is stored as its difference from the previous change.
    Such differences compress well.
    """
    ordered = changes[np.argsort(changes[:, 1], kind="stable")]
    return zlib.compress(np.diff(ordered, axis=0, prepend=0).T.astype("<i4").tobytes())


def _expanded(block: bytes) -> Changes:
    reader = zlib.decompressobj()
    try:
        data = reader.decompress(block, _MOST)
    except zlib.error:
        raise _bad() from None
    if not reader.eof or len(data) % 12:
        raise _bad()
    return np.frombuffer(data, dtype="<i4").reshape(3, -1).T.cumsum(axis=0, dtype=np.int32)


def _triples(data: bytes) -> Changes:
    if len(data) % 12:
        raise _bad()
    return np.frombuffer(data, dtype="<i4").reshape(-1, 3)


def _bad() -> BadFile:
    return BadFile("the recording of the tables cannot be read")


class TapeRecorder:
    """Compares the tables of a machine with what they contained before, and records the changes."""

    def __init__(
        self, machine: Machine, interpreters: Mapping[Side, Interpreter], program: StoredProgram
    ) -> None:
        self.tape = Tape()
        self.segments = segments([*machine.levels])
        self.hear: Callable[[Changes], None] | None = None  # called with all changes, for a live page
        self._machine = machine
        self._new: list[bytes] = []  # changes since the last statement
        self._fast = _Fast(machine, self.segments)
        self._events: list[_Source] = []
        self._others: list[_Source] = []  # tables that only statements change
        for segment in self.segments:
            side: Side = "left" if segment.side == "left" else "right"
            seen = _views(interpreters[side], program).get(segment.table)
            if segment.table in (*_LINES, *_WORDS, *_SHARED):
                continue
            if segment.table == "TK":
                self._others.append(_Program(segment, program))
            elif seen is not None:
                self._others.append(_Viewed(segment, *seen))
            elif segment.table == "US":
                self._others.append(_Sparse(segment, machine.memory.shared))
            else:
                kept = self._events if segment.table in _EVENTS else self._others
                kept.append(_stored(segment, machine.memory.arms[side], machine.memory.shared))

    def cycle(self) -> None:
        """Record what has changed in the cycle that has just passed."""
        cycle = self._machine.now - 1
        self._fast.take(cycle)
        self._look(self._events, cycle)
        if self.hear is not None:
            self._compare()

    def statement(self) -> None:
        """Record what a statement has changed, and add all changes since the previous statement to the tape."""
        self._fast.take(self._machine.now)
        self._look(self._events + self._others, self._machine.now)
        self._compare()
        tape = self.tape
        tape.open += b"".join(self._new)
        self._new.clear()
        if len(tape.open) >= BLOCK:
            tape.blocks, tape.open = (*tape.blocks, _compressed(_triples(tape.open))), b""

    def restart(self) -> None:
        """Continue from a state that was restored."""
        self._new.clear()
        self._fast.restart(self._machine.now)
        for source in self._events + self._others:
            source.look([])

    def _look(self, sources: Sequence["_Source"], cycle: int) -> None:
        found: list[int] = []
        for source in sources:
            source.look(found)
        if found:
            pairs = np.reshape(found, (-1, 2))
            self._add(np.column_stack([np.full(len(pairs), cycle), pairs]))

    def _compare(self) -> None:
        found = self._fast.changes()
        if len(found):
            self._add(found)

    def _add(self, changes: NDArray[Any]) -> None:
        self._new.append(changes.astype("<i4").tobytes())
        if self.hear is not None:
            self.hear(changes)


class _Fast:
    """The tables that change in most cycles. These tables are copied in each cycle, and compared later."""

    def __init__(self, machine: Machine, tables: Sequence[Segment]) -> None:
        arms, shared = machine.memory.arms, machine.memory.shared
        self._kept = [(arms[side], _LINES, _WORDS) for side in machine.levels]
        self._shared = shared
        places = [
            segment
            for side in machine.levels
            for names in (_LINES, _WORDS)
            for name in names
            for segment in tables
            if (segment.side, segment.table) == (side, name)
        ] + [segment for segment in tables if segment.table in _SHARED]
        self._numbers = np.concatenate([np.arange(each.base, each.base + each.size) for each in places])
        self._last = np.zeros((1, len(self._numbers)), dtype=np.int16)
        self._cycles: list[int] = []
        self._words = array("h")

    def take(self, cycle: int) -> None:
        """Copy the tables."""
        flat: list[int] = []
        for memory, lines, words in self._kept:
            for name in lines:
                for line in getattr(memory, name):
                    flat += astuple(line)
            for name in words:
                flat += getattr(memory, name)
        flat += self._shared.TM
        self._words.fromlist(flat)
        self._cycles.append(cycle)

    def changes(self) -> NDArray[Any]:
        """Return the changes between the copies, and forget all copies but the last."""
        if not self._cycles:
            return np.empty((0, 3), dtype=np.int32)
        copies = np.frombuffer(self._words, dtype=np.int16).reshape(len(self._cycles), -1)
        rows, columns = np.nonzero(copies != np.concatenate([self._last, copies[:-1]]))
        found = np.column_stack([np.array(self._cycles)[rows], self._numbers[columns], copies[rows, columns]])
        self._last = copies[-1:].copy()
        del copies
        del self._words[:]
        self._cycles.clear()
        return found

    def restart(self, cycle: int) -> None:
        """Begin with the present contents of the tables."""
        del self._words[:]
        self._cycles.clear()
        self.take(cycle)
        self.changes()


def _compare(row: list[int], base: int, was: Sequence[int], now: Sequence[int]) -> None:
    """Append to `row` the number and the value of each word that has changed. The first word has the number `base`."""
    for place in compress(count(), map(ne, was, now)):
        row += (base + place, now[place])


class _Source(ABC):
    """A table and its earlier contents."""

    @abstractmethod
    def look(self, row: list[int]) -> None:
        """Append to `row` the number and the value of each word that has changed."""


def _stored(segment: Segment, *memories: MutableRecord) -> _Source:
    memory = next(each for each in memories if hasattr(each, segment.table))
    first = getattr(memory, segment.table)[0]
    return _Records(segment, memory) if isinstance(first, Record) else _Words(segment, memory)


class _Words(_Source):
    """A table that is kept as a sequence of words."""

    def __init__(self, segment: Segment, memory: MutableRecord) -> None:
        self._base, self._memory, self._name = segment.base, memory, segment.table
        self._was: Sequence[int] = [0] * segment.size

    def look(self, row: list[int]) -> None:
        now = getattr(self._memory, self._name)
        if now != self._was:
            _compare(row, self._base, self._was, now)
            self._was = now if isinstance(now, tuple) else [*now]


class _Records(_Source):
    """A table that is kept as a list of records. When a line changes, a new record replaces the old one."""

    def __init__(self, segment: Segment, memory: MutableRecord) -> None:
        self._segment, self._memory = segment, memory
        self._seen: Sequence[Record] = ()
        self._was = [0] * segment.size

    def look(self, row: list[int]) -> None:
        seen = getattr(self._memory, self._segment.table)
        if seen != self._seen:
            now = [word for line in seen for word in astuple(line)]
            _compare(row, self._segment.base, self._was, now)
            self._seen, self._was = [*seen], now


class _Sparse(_Source):
    """The table US, of which only words that are not 0 are kept."""

    def __init__(self, segment: Segment, memory: Any) -> None:
        self._base, self._memory = segment.base, memory
        self._was: dict[int, int] = {}

    def look(self, row: list[int]) -> None:
        now, was = self._memory.US, self._was
        if now != was:
            for place in sorted({*now, *was}):
                if now.get(place, 0) != was.get(place, 0):
                    row += (self._base + place, now.get(place, 0))
            self._was = dict(now)


class _Viewed(_Source):
    """A table that the background level keeps. The table can have changed only if the value of `key` has changed."""

    def __init__(self, segment: Segment, view: View, key: Callable[[], object]) -> None:
        self._segment, self._view, self._key = segment, view, key
        self._seen: object = None
        self._was = [0] * segment.size

    def look(self, row: list[int]) -> None:
        key = self._key()
        if key != self._seen:
            shape, read = self._segment.shape, self._view.read
            places = (
                (line, word) for line in range(1, shape.lines + 1) for word in range(1, shape.words + 1)
            )
            now = [read(line, word) for line, word in places]
            _compare(row, self._segment.base, self._was, now)
            self._seen, self._was = key, now


def _views(mos: Interpreter, program: StoredProgram) -> dict[str, tuple[View, Callable[[], object]]]:
    """Return the tables of the background level, and a function for each table. When the table changes, the value of
    its function changes.
    """
    memory, points = mos.memory, program.memory
    return {
        "PT": (RecentPoints(program), lambda: ([*points.recent], dict(points.points))),
        "TR": (TraceBuffer(mos), lambda: [*memory.traced]),
        "LG": (SessionLog(mos), lambda: [*memory.typed]),
        "HL": (HostLink(mos), lambda: (mos.host is None, memory.closed, memory.sent, memory.received)),
        "CC": (CommandCodes(), lambda: ()),
        "ER": (ErrorTexts(), lambda: ()),
    }


class _Program(_Source):
    """The table TK."""

    def __init__(self, segment: Segment, program: StoredProgram) -> None:
        self._segment, self._program, self._view = segment, program, TaskTable(program)
        self._texts: dict[int, str] = {}
        self._points: dict[int, tuple[int, ...]] = {}
        self._was: dict[int, list[int]] = {}

    def look(self, row: list[int]) -> None:
        memory = self._program.memory
        texts, points = memory.statements, memory.points
        if texts == self._texts and points == self._points:
            return
        wide = self._segment.shape.words
        for line in sorted({*texts, *self._texts}):
            if (texts.get(line), points.get(line)) != (self._texts.get(line), self._points.get(line)):
                was = self._was.get(line, [0] * wide)
                words = self._was[line] = [self._view.read(line, word) for word in range(1, wide + 1)]
                _compare(row, self._segment.number(line, 1), was, words)
        self._texts, self._points = dict(texts), dict(points)
