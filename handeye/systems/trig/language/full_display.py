"""Full display: the whole program in miniature, a character a step, the active one in brackets.

It is drawn from left to right, as a screen is wider than high: the normal son stands to the right of a step, the
guarded one begins below.
"""

from typing import Final

from handeye.systems.trig.language.layout import Cell, Elbow, layout
from handeye.systems.trig.language.node import NONE, TOP, NodeType
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.styled import Line, Style
from handeye.systems.trig.language.symbols import UNICODE, Symbols

SIGNS: Final[dict[NodeType, str]] = {
    "top": "*", "normal": "o", "guarded": "<", "grasp": "c", "ungrasp": "u", "savpos": "=", "loop": "@"
}  # fmt: skip
LINK: Final = "^"
_STYLES: Final[dict[str, Style]] = {"c": "hand", "u": "hand", "<": "guarded", "@": "loop", LINK: "link"}

_Grid = dict[tuple[int, int], tuple[Style, str]]  # by row and column


def full_display(program: TrigProgram, width: int, height: int, symbols: Symbols = UNICODE) -> list[Line]:
    """Draw the program, or as much of it around the active step as fits."""
    if program.first == NONE:
        return [[("active", "[ ]")]]
    drawn = layout(program.graph, top=program.cursor == TOP)
    grid: _Grid = {}
    for cell in drawn.cells:
        _put_step(grid, cell, symbols)
    for elbow in drawn.elbows:
        _put_elbow(grid, elbow, symbols)
    active = next((c for c in drawn.cells if c.node.id == program.cursor and not c.link), None)
    if active is not None:
        _put_brackets(grid, active.column, 2 * active.row)
    row, column = (0, 0) if active is None else (active.column, 2 * active.row)
    wide, high = 2 * drawn.rows, drawn.columns
    left = max(-1, min(column - width // 2, wide - width + 1)) if wide >= width else -1
    top = max(0, min(row - height // 2, high - height))
    return [_line(grid, top + below, left, width, symbols) for below in range(min(height, max(high, 1)))]


def _put_step(grid: _Grid, cell: Cell, symbols: Symbols) -> None:
    sign = LINK if cell.link else SIGNS[cell.node.type]
    grid[cell.column, 2 * cell.row] = (_STYLES.get(sign, "position"), sign)
    if cell.branch != "g" and cell.row > 0:
        grid[cell.column, 2 * cell.row - 1] = ("line", symbols.line)


def _put_elbow(grid: _Grid, elbow: Elbow, symbols: Symbols) -> None:
    x = 2 * elbow.row + 1
    grid[elbow.start, x] = ("line", symbols.tee)
    for row in range(elbow.start + 1, elbow.end):
        grid[row, x] = ("line", symbols.stem)
    grid[elbow.end, x] = ("line", symbols.turn)


def _put_brackets(grid: _Grid, row: int, column: int) -> None:
    grid[row, column - 1] = ("active", "[")
    grid[row, column] = ("active", grid[row, column][1])
    grid[row, column + 1] = ("active", "]")


def _line(grid: _Grid, row: int, left: int, width: int, symbols: Symbols) -> Line:
    """One line of the picture, with a sign where it continues beyond its ends."""
    last = max((x for y, x in grid if y == row), default=-2)
    line = [grid.get((row, x), ("", " ")) for x in range(left, min(last, left + width - 1) + 1)]
    if line and left > -1 and any((row, x) in grid for x in range(left)):
        line[0] = ("line", symbols.more)
    if line and last >= left + width:
        line[-1] = ("line", symbols.more)
    return line
