"""Partial display: the steps around the active one, a row each, in as much detail as there is room for."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from handeye.trig.graph import Graph
from handeye.trig.layout import Cell, Elbow, Layout, layout
from handeye.trig.node import NONE, TOP, TOP_NAME, UNNAMED, Node
from handeye.trig.position import Positions, is_named
from handeye.trig.program import TrigProgram
from handeye.trig.symbols import UNICODE, Symbols

Style = str
"""What a piece of text is: `active`, `name`, `position`, `hand`, `guarded`, `loop`, `link`, `line`, or nothing."""
Line = list[tuple[Style, str]]
"""Pieces of text from left to right."""
NO_POSITION: Final = "- -"
GUARD: Final = " G"
"""Behind the position of a guarded step."""
_NARROWEST: Final = 18
"""Characters of a column."""
_LONGEST: Final = 16
"""Characters of a name, before it is cut."""
_GAP: Final = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class _Columns:
    """Widths that all columns have, in characters."""

    name: int
    whole: int


def partial_display(program: TrigProgram, width: int, height: int, symbols: Symbols = UNICODE) -> list[Line]:
    """Draw as many steps as there is room for; the active one is among them, with one above it."""
    if program.first == NONE:
        return [[("active", symbols.cursor)]]
    drawn = layout(program.graph, top=program.cursor == TOP)
    active = next((c for c in drawn.cells if c.node.id == program.cursor and not c.link), None)
    columns = _columns(program, drawn, width, symbols)
    first_row = _scrolled(0 if active is None else active.row, drawn.rows, height, above=height // 3)
    shown = max(1, (width + _GAP) // (columns.whole + _GAP))
    first_column = _scrolled(0 if active is None else active.column, drawn.columns, shown, above=shown - 1)
    cells = {
        (cell.row - first_row, cell.column - first_column): cell
        for cell in drawn.cells
        if cell.row < first_row + height and first_row <= cell.row
    }
    elbows = {
        elbow.row - first_row: elbow for elbow in drawn.elbows if first_row <= elbow.row < first_row + height
    }
    rows = min(height, drawn.rows - first_row)
    return [
        _row(program, row, shown, cells, elbows.get(row), first_column, columns, symbols)
        for row in range(rows)
    ]


def _scrolled(active: int, count: int, room: int, above: int) -> int:
    """The first of those that are shown: the active one is, with some above it if there are."""
    return max(0, min(active - above, count - room))


def _columns(program: TrigProgram, drawn: Layout, width: int, symbols: Symbols) -> _Columns:
    pairs = [words(program.graph, program.positions, cell, symbols) for cell in drawn.cells]
    name = max([len(UNNAMED)] + [min(_LONGEST, len(words[0])) for words in pairs if words[1]])
    whole = max([_NARROWEST] + [3 + (name + 2 + len(two) if two else len(one)) for one, two, _ in pairs])
    return _Columns(name=name, whole=min(whole, width))


def words(
    graph: Graph, positions: Positions, cell: Cell, symbols: Symbols = UNICODE
) -> tuple[str, str, Style]:
    """Name and position of a step as they are shown, or a text in the place of both, and what that is."""
    node = cell.node
    if cell.link:
        return f"[{_cut(node.name or UNNAMED, symbols)}]", "", "link"
    if node.type == "top":
        return TOP_NAME.lower(), "", "name"
    if node.type == "loop":
        target = graph.target(node)
        name = UNNAMED if target is None else target.name or UNNAMED
        return f"LOOP {_cut(name, symbols)} {node.wanted} ({node.count})", "", "loop"
    style = {"guarded": "guarded", "normal": "position", "savpos": "position"}.get(node.type, "hand")
    return _cut(node.name or UNNAMED, symbols), _position(node, positions, symbols), style


def _position(node: Node, positions: Positions, symbols: Symbols) -> str:
    """What a step does, in a word."""
    if node.position is None:
        return f"({node.type})"
    name = _cut(node.position, symbols) if is_named(node.position) else NO_POSITION
    sign = "#" if positions[node.position].relative else ""
    minus = "-" if node.negate else ""
    guard = GUARD if node.type == "guarded" else ""
    return f"{'=' if node.type == 'savpos' else ''}{minus}{sign}{name}{guard}"


def _cut(name: str, symbols: Symbols) -> str:
    return name if len(name) <= _LONGEST else name[: _LONGEST - 1] + symbols.more


def _row(
    program: TrigProgram,
    row: int,
    shown: int,
    cells: dict[tuple[int, int], Cell],
    elbow: Elbow | None,
    first: int,
    columns: _Columns,
    symbols: Symbols,
) -> Line:
    """One row of the display."""
    line: Line = []
    for column in range(shown):
        cell = cells.get((row, column))
        start = len(plain([line]))
        pieces = [] if cell is None else _pieces(program, cell, columns, symbols)
        line += pieces
        room = columns.whole + _GAP - (len(plain([line])) - start)
        line.append(_filled(room, column + first, elbow, symbols))
    _strip(line)
    return line


def _strip(line: Line) -> None:
    """Take the blanks at the end of a line away."""
    while line and not line[-1][1].strip():
        line.pop()
    if line:
        line[-1] = (line[-1][0], line[-1][1].rstrip())


def _filled(room: int, column: int, elbow: Elbow | None, symbols: Symbols) -> tuple[Style, str]:
    """What stands behind a step: nothing, or the line that leads to the right."""
    if elbow is None or not elbow.start <= column <= elbow.end:
        return "", " " * room
    if column == elbow.end:
        return "line", (symbols.line * 3 + symbols.corner).ljust(room)
    return "line", " " + symbols.line * (room - 1)


def _pieces(program: TrigProgram, cell: Cell, columns: _Columns, symbols: Symbols) -> Line:
    one, two, style = words(program.graph, program.positions, cell, symbols)
    active = cell.node.id == program.cursor and not cell.link
    marker = symbols.cursor if active else " "
    whole = f"{one:{columns.name}}  {two}" if two else one
    room = columns.whole - 3
    if active:
        return [("active", f"{marker}{cell.branch:1} {whole[:room]}")]
    if not two:
        return [("branch", f" {cell.branch:1} "), (style, one[:room])]
    return [
        ("branch", f" {cell.branch:1} "),
        ("name", f"{one:{columns.name}}  "),
        (style, two[: room - columns.name - 2]),
    ]


def plain(lines: Sequence[Line]) -> str:
    """The text of lines alone."""
    return "\n".join("".join(text for _, text in line) for line in lines)
