"""Makes timing diagrams of the bus from its log: the levels of the lines, and the bytes that each receiver
took."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from handeye.core.markup import Markup, element, joined
from handeye.core.plain_text import counted
from handeye.ports.microbus import COMMAND_BYTES, Status
from handeye.systems.sigma.bus.events import (
    AnyBusEvent,
    ByteHeard,
    ByteSpoken,
    CommandSent,
    FrameTaken,
    InterruptLine,
    StatusLines,
)
from handeye.systems.sigma.bus.wires import OPEN
from handeye.systems.sigma.bus.words import spaced
from handeye.systems.sigma.firmware.device import PS
from handeye.systems.sigma.protocol import NUMBERS, Timing, name_of

_ALWAYS_BUSY: Final = "FORCE"  # microcomputers whose names begin like this show BUSY from power-on


@dataclass(frozen=True, slots=True)
class Wave:
    """One line of the bus: its first level, and the times at which the level changes (ps)."""

    name: str
    first: int
    changes: tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class Mark:
    """A byte that a receiver took, with the time (ps)."""

    at: int
    byte: int
    right: bool  # True: it is the byte that was on the lines
    own: bool  # True: the receiver acted on its frame, or it belongs to an answer
    first: bool  # True: it is the first byte of its frame


@dataclass(frozen=True, slots=True)
class Receiver:
    """The bytes that one microcomputer, or the central computer, took from the lines."""

    name: str
    marks: tuple[Mark, ...]
    says: str


@dataclass(frozen=True, slots=True)
class Diagram:
    """The lines and receivers of the bus between two times (ps)."""

    title: str
    begin: int
    end: int
    slot: int  # ps: duration of a byte of a command
    data: tuple[tuple[int, int, int], ...]  # from, to, byte
    strobes: tuple[Wave, ...]
    lines: tuple[Wave, ...]  # status lines and interrupt
    receivers: tuple[Receiver, ...]


def diagram(
    title: str, log: Sequence[AnyBusEvent], begin: int, end: int, timing: Timing, *, all_lines: bool = False
) -> Diagram:
    """Make the diagram of a log between two times (microseconds). If `all_lines` is True, the diagram includes status
    lines that do not change.
    """
    first, last = begin * PS, end * PS
    sent = [e for e in log if isinstance(e, CommandSent)]
    spoken = [e for e in log if isinstance(e, ByteSpoken)]
    bytes_on = [
        (e.at + n * timing.slot * PS, e.at + (n + 1) * timing.slot * PS, byte)
        for e in sent
        for n, byte in enumerate(e.frame)
    ] + [(e.at, e.until, e.byte) for e in spoken]
    strobes = (
        _strobe("/DATA READY", [(e.falls, e.rises) for e in sent], first, last),
        _strobe("/ANSWER READY", [(e.at, e.until) for e in spoken], first, last),
    )
    return Diagram(
        title=title,
        begin=first,
        end=last,
        slot=timing.slot * PS,
        data=tuple(sorted(piece for piece in bytes_on if piece[0] < last and piece[1] > first)),
        strobes=strobes,
        lines=tuple(_status_lines(log, first, last, all_lines=all_lines)),
        receivers=tuple(_receivers(log, sent, first, last)),
    )


def _strobe(name: str, lows: Sequence[tuple[int, int]], first: int, last: int) -> Wave:
    changes = sorted(change for low in lows for change in ((low[0], 0), (low[1], 1)))
    return _cut(name, 1, changes, first, last)


def _cut(name: str, level: int, changes: Sequence[tuple[int, int]], first: int, last: int) -> Wave:
    for at, after in changes:
        if at <= first:
            level = after
    kept, now = [], level
    for at, after in changes:
        if first < at < last and after != now:
            kept.append((at, after))
            now = after
    return Wave(name, level, tuple(kept))


def _status_lines(log: Sequence[AnyBusEvent], first: int, last: int, *, all_lines: bool) -> Iterator[Wave]:
    shown = [e for e in log if isinstance(e, StatusLines)]
    numbers = {e.number for e in shown} | ({*NUMBERS.values()} if all_lines else set())
    for number in sorted(numbers):
        name = name_of(number)
        begins = int(Status.BUSY if name.startswith(_ALWAYS_BUSY) else Status.FREE)
        mine = [e for e in shown if e.number == number]
        for line, shift in (("A", 1), ("B", 0)):
            changes = [(e.at, e.status >> shift & 1) for e in mine]
            wave = _cut(f"{name} {line}", begins >> shift & 1, changes, first, last)
            if wave.changes or all_lines:
                yield wave
    levels = [(e.at, int(e.level)) for e in log if isinstance(e, InterruptLine)]
    interrupt = _cut("interrupt", 0, levels, first, last)
    if interrupt.changes or all_lines:
        yield interrupt


def _receivers(
    log: Sequence[AnyBusEvent], sent: Sequence[CommandSent], first: int, last: int
) -> Iterator[Receiver]:
    taken = [e for e in log if isinstance(e, FrameTaken) and first <= e.noticed < last]
    starts = [s.at for s in sent]
    for number in sorted({e.number for e in taken}):
        mine = [e for e in taken if e.number == number]
        marks: list[Mark] = []
        for e in mine:
            meant = sent[bisect_right(starts, e.noticed) - 1].frame if sent else b""
            trios = zip(e.sampled, e.frame, meant, strict=False)
            marks += [
                Mark(at, byte, byte == right, e.own, n == 0) for n, (at, byte, right) in enumerate(trios)
            ]
        says = f"{spaced(mine[0].frame)}{' own' if mine[0].own else ''}"
        if len(mine) > 1:
            says = f"{counted(len(mine), 'frame')}, {sum(e.own for e in mine)} own"
        yield Receiver(name_of(number), tuple(marks), says)
    heard = [e for e in log if isinstance(e, ByteHeard) and first <= e.at < last]
    spoken = [e for e in log if isinstance(e, ByteSpoken)]
    if heard:
        right = [any(s.at <= e.at < s.until and s.byte == e.byte for s in spoken) for e in heard]
        pairs = zip(heard, right, strict=True)
        all_heard = tuple(Mark(e.at, e.byte, well, own=True, first=True) for e, well in pairs)
        says = (
            spaced(bytes(e.byte for e in heard))
            if len(heard) <= COMMAND_BYTES
            else counted(len(heard), "byte")
        )
        yield Receiver("computer", all_heard, says)


# -- as text ---------------------------------------------------------------------------------------------

_NAME: Final = 15  # columns that the names take
_UNICODE: Final = ("▔", "▁", "│")
_ASCII: Final = ("-", "_", "|")


def as_text(drawn: Diagram, width: int = 100, *, ascii: bool = False) -> list[str]:
    """Return a diagram as lines of text. The time axis always has at least 20 columns. Apart from that, the lines have
    at most `width` characters.
    """
    behind = max((len(receiver.says) + 1 for receiver in drawn.receivers), default=0)
    columns = max(20, width - _NAME - behind)
    scale = (drawn.end - drawn.begin) / columns
    high, low, edge = _ASCII if ascii else _UNICODE
    narrow = scale > drawn.slot / 2  # bytes lie too close to each other to be distinguished

    def column(at: int) -> int:
        return int((at - drawn.begin) / scale)

    def level(wave: Wave) -> str:
        out, now, changes = [], wave.first, [*wave.changes]
        for place in range(columns):
            changed = False
            while changes and column(changes[0][0]) <= place:
                now, changed = changes.pop(0)[1], True
            out.append(edge if changed else high if now else low)
        return "".join(out)

    out = [drawn.title, f"{_unit(drawn)[0]:<{_NAME}}{_axis(drawn, columns)}"]
    data = [" "] * columns
    for start, _end, byte in () if narrow else drawn.data:
        for offset, sign in enumerate(f"{edge}{byte:02X}"):
            if 0 <= (place := column(start) + offset) < columns:
                data[place] = sign
    out.append(f"{'data':<{_NAME}}{''.join(data).rstrip()}")
    out += [f"{wave.name:<{_NAME}}{level(wave)}" for wave in drawn.strobes]
    for receiver in drawn.receivers:
        row = [" "] * columns
        for mark in receiver.marks:
            if 0 <= (place := column(mark.at)) < columns and row[place] in " .":
                row[place] = "!" if not mark.right else "^" if mark.own or not narrow else "."
        out.append(f"{receiver.name:<{_NAME}}{''.join(row)} {receiver.says}")
    out += [f"{wave.name:<{_NAME}}{level(wave)}" for wave in drawn.lines]
    return [line.rstrip() for line in out]


def _axis(drawn: Diagram, columns: int) -> str:
    row, last = [" "] * (columns + 12), -2
    for at in _ticks(drawn, columns // 9):
        place = int((at - drawn.begin) / (drawn.end - drawn.begin) * columns)
        text = f"{at / PS / _unit(drawn)[1]:g}"
        if place > last + 1 and place + len(text) <= columns:
            row[place : place + len(text)] = text
            last = place + len(text)
    return "".join(row).rstrip()


def _unit(drawn: Diagram) -> tuple[str, int]:
    """Return the unit of the time axis, and its length (microseconds)."""
    units = (("microseconds", 1), ("milliseconds", 1_000), ("seconds", 1_000_000))
    span = (drawn.end - drawn.begin) // PS
    return max((unit for unit in units if span >= 20 * unit[1]), key=lambda unit: unit[1], default=units[0])


def _ticks(drawn: Diagram, most: int) -> list[int]:
    """Return the times (ps) of the ticks on the time axis. The times are multiples of a round number."""
    span = (drawn.end - drawn.begin) // PS
    step = next(
        (digit * 10**power for power in range(12) for digit in (1, 2, 5) if digit * 10**power * most >= span),
        span,
    )
    first = -(-drawn.begin // (step * PS)) * step
    return [at * PS for at in range(first, drawn.end // PS + 1, step)]


# -- as a drawing ----------------------------------------------------------------------------------------

_LEFT: Final = 118  # px: width of the names
_WIDTH: Final = 900  # px: width of the time axis
_ROW: Final = 24  # px: height of a row
_HIGH: Final = 13  # px between levels
_SAYS: Final = 150  # px: width of the text after a row
_HEAD: Final = 46
_BELOW: Final = 14
_SHORT: Final = {"microseconds": "µs", "milliseconds": "ms", "seconds": "s"}
_READABLE: Final = 16  # px that a byte in hexadecimal takes
_STYLE: Final = (
    "text{font:11px ui-monospace,'DejaVu Sans Mono',Menlo,Consolas,monospace;fill:#222}"
    ".t{font:600 14px system-ui,'DejaVu Sans',Helvetica,Arial,sans-serif}.a{fill:#777;font-size:10px}"
    ".w{fill:none;stroke:#3b75af;stroke-width:1.5}.s{fill:none;stroke:#b98113;stroke-width:1.5}"
    ".b{fill:none;stroke:#3f8f52;stroke-width:1.5}.g{stroke:#eceef1}.m{stroke:#333}.x{stroke:#c8382e;stroke-width:2}"
    ".o{stroke:#c9ced6}.d{fill:#dbe9f6;stroke:#3b75af}.r{fill:#c8382e}.c{text-anchor:middle}"
)


def as_svg(*drawings: Diagram) -> str:
    """Return diagrams, one below the other, as SVG with searchable text."""
    pieces, top = [], 0
    for drawn in drawings:
        piece, height = _drawing(drawn, top)
        pieces.append(piece)
        top += height
    width = _LEFT + _WIDTH + _SAYS
    paper = element("rect", width=width, height=top, fill="#fff")
    svg = element(
        "svg", element("style", Markup(_STYLE)), paper, joined(pieces, "\n"),
        xmlns="http://www.w3.org/2000/svg", viewBox=f"0 0 {width} {top}", width=width, height=top,
    )  # fmt: skip
    return f"{svg}\n"


def _drawing(drawn: Diagram, top: int) -> tuple[Markup, int]:
    bits = [_bit(drawn, bit) for bit in reversed(range(8))]
    rows: list[Markup] = [_bytes(drawn, top + _HEAD)]
    y = top + _HEAD + _ROW
    for wave, kind in (
        *((bit, "w") for bit in bits),
        *((strobe, "s") for strobe in drawn.strobes),
    ):
        rows.append(_wave(drawn, wave, kind, y))
        y += _ROW
    for receiver in drawn.receivers:
        rows.append(_receiver(drawn, receiver, y))
        y += _ROW
    for wave in drawn.lines:
        rows.append(_wave(drawn, wave, "b", y))
        y += _ROW
    title = element("text", drawn.title, x=10, y=top + 20, class_="t")
    return joined([title, *_grid(drawn, top + _HEAD, y), *rows], "\n"), y + _BELOW - top


def _bit(drawn: Diagram, bit: int) -> Wave:
    """Return the wave of one data line. The line is high while no device drives it."""
    changes: list[tuple[int, int]] = []
    for start, end, byte in drawn.data:
        changes += [(start, byte >> bit & 1), (end, OPEN >> bit & 1)]
    merged = dict(changes)  # if a byte begins where another ends, the new byte counts
    for start, _end, byte in drawn.data:
        merged[start] = byte >> bit & 1
    return _cut(f"D{bit}", 1, sorted(merged.items()), drawn.begin, drawn.end)


def _x(drawn: Diagram, at: int) -> float:
    share = (at - drawn.begin) / (drawn.end - drawn.begin)
    return round(_LEFT + _WIDTH * min(max(share, 0.0), 1.0), 1)


def _grid(drawn: Diagram, top: int, bottom: int) -> Iterator[Markup]:
    for at in _ticks(drawn, 16):
        x = _x(drawn, at)
        yield element("line", x1=x, x2=x, y1=top - 6, y2=bottom, class_="g")
        yield element("text", f"{at / PS / _unit(drawn)[1]:g}", x=x, y=top - 10, class_="a c")
    yield element("text", _SHORT[_unit(drawn)[0]], x=_LEFT + _WIDTH + 12, y=top - 10, class_="a")


def _bytes(drawn: Diagram, y: int) -> Markup:
    pieces = [element("text", "data", x=10, y=y + 14)]
    for start, end, byte in drawn.data:
        left, right = _x(drawn, start), _x(drawn, end)
        box = element("rect", x=left, y=y + 2, width=round(max(right - left, 0.5), 1), height=16, class_="d")
        pieces.append(box)
        if right - left > _READABLE:
            pieces.append(
                element("text", f"{byte:02X}", x=round((left + right) / 2, 1), y=y + 14, class_="c")
            )
    return joined(pieces)


def _wave(drawn: Diagram, wave: Wave, kind: str, y: int) -> Markup:
    def height(level: int) -> int:
        return y + 4 + (0 if level else _HIGH)

    path = f"M{_LEFT} {height(wave.first)}"
    for at, after in wave.changes:
        path += f"H{_x(drawn, at):g}V{height(after)}"
    path += f"H{_LEFT + _WIDTH}"
    return joined([element("text", wave.name, x=10, y=y + 14), element("path", d=path, class_=kind)])


def _receiver(drawn: Diagram, receiver: Receiver, y: int) -> Markup:
    pieces = [element("text", receiver.name, x=10, y=y + 14)]
    readable = drawn.slot * _WIDTH > _READABLE * (drawn.end - drawn.begin)
    for mark in sorted(receiver.marks, key=lambda mark: mark.own):  # its own frames last, over the others
        if not drawn.begin <= mark.at < drawn.end or not (readable or mark.first or not mark.right):
            continue
        x = _x(drawn, mark.at)
        kind = "m x" if not mark.right else "m" if readable else "m b" if mark.own else "o"
        pieces.append(element("line", x1=x, x2=x, y1=y + 3, y2=y + 18, class_=kind))
        if readable:
            wrong = None if mark.right else "r"
            pieces.append(element("text", f"{mark.byte:02X}", x=x + 3, y=y + 14, class_=wrong))
    pieces.append(element("text", receiver.says, x=_LEFT + _WIDTH + 8, y=y + 14, class_="a"))
    return joined(pieces)
