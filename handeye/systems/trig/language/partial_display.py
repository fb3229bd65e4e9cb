"""Partial display: the steps around the active one, a row each, in as much detail as fits."""

from dataclasses import dataclass
from typing import Final

from handeye.systems.trig.language.layout import Cell, Elbow, Layout, layout
from handeye.systems.trig.language.node import NONE, TOP, UNNAMED
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.step_words import step_words
from handeye.systems.trig.language.styled import Line, Style, fitted, plain
from handeye.systems.trig.language.symbols import UNICODE, Symbols

_MIN_COLUMN: Final = 18  # characters
_GAP: Final = 2  # characters between columns
_MARKER: Final = 3  # characters before a name: cursor and branch


@dataclass(frozen=True, slots=True, kw_only=True)
class _Pane:
    """The part of a program that is shown; widths in characters, cells by row and column, elbows by row."""

    program: TrigProgram
    symbols: Symbols
    name: int
    column: int
    cells: dict[tuple[int, int], Cell]
    elbows: dict[int, Elbow]


def partial_display(program: TrigProgram, width: int, height: int, symbols: Symbols = UNICODE) -> list[Line]:
    """Draw as many steps as fit, the active one among them with one above it."""
    if program.first == NONE:
        return [[("active", symbols.cursor)]]
    drawn = layout(program.graph, top=program.cursor == TOP)
    pane = _pane(program, drawn, width, symbols)
    active = next(cell for cell in drawn.cells if cell.node.id == program.cursor and not cell.link)
    shown = max(1, (width + _GAP) // (pane.column + _GAP))
    first = _scrolled(active.row, drawn.rows, height, above=height // 3)
    left = _scrolled(active.column, drawn.columns, shown, above=shown - 1)
    rows = range(first, min(first + height, drawn.rows))
    return [fitted(_row(pane, row, range(left, left + shown)), width) for row in rows]


def _scrolled(active: int, count: int, room: int, above: int) -> int:
    """The first row shown, so that the active one is visible, with some above it."""
    return max(0, min(active - above, count - room))


def _pane(program: TrigProgram, drawn: Layout, width: int, symbols: Symbols) -> _Pane:
    words = [step_words(program.graph, program.positions, cell, symbols) for cell in drawn.cells]
    name = max([len(UNNAMED), *(len(name) for name, deed, _ in words if deed)])
    widths = (name + _GAP + len(deed) if deed else len(text) for text, deed, _ in words)
    return _Pane(
        program=program,
        symbols=symbols,
        name=name,
        column=min(width, max(_MIN_COLUMN, *(_MARKER + width for width in widths))),
        cells={(cell.row, cell.column): cell for cell in drawn.cells},
        elbows={elbow.row: elbow for elbow in drawn.elbows},
    )


def _row(pane: _Pane, row: int, columns: range) -> Line:
    """One row of the display."""
    line: Line = []
    for column in columns:
        cell = pane.cells.get((row, column))
        pieces = [] if cell is None else _pieces(pane, cell)
        room = pane.column + _GAP - len(plain([pieces]))
        line += [*pieces, _filled(room, column, pane.elbows.get(row), pane.symbols)]
    return line


def _filled(room: int, column: int, elbow: Elbow | None, symbols: Symbols) -> tuple[Style, str]:
    """What follows a step: blanks, or the line to the right."""
    if elbow is None or not elbow.start <= column <= elbow.end:
        return "", " " * room
    if column == elbow.end:
        return "line", (symbols.line * _MARKER + symbols.corner).ljust(room)
    return "line", " " + symbols.line * (room - 1)


def _pieces(pane: _Pane, cell: Cell) -> Line:
    """A step with its cursor or branch mark."""
    name, deed, style = step_words(pane.program.graph, pane.program.positions, cell, pane.symbols)
    text = f"{name:{pane.name}}  " if deed else ""
    if cell.node.id == pane.program.cursor and not cell.link:
        line = [("active", f"{pane.symbols.cursor}{cell.branch:1} {text}{deed or name}")]
    else:
        line = [("branch", f" {cell.branch:1} "), ("name", text), (style, deed or name)]
    return fitted(line, pane.column)
