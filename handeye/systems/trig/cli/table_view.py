"""Draws the arm and its table as text: the table seen from above, and a scale that shows the height of the hand."""

from collections.abc import Mapping
from typing import Final

from handeye.systems.trig.language.place import AXES, Place, Position, is_named
from handeye.systems.trig.language.styled import Line, Symbols, fitted

WIDTH: Final = 46  # columns of the drawing
_WIDE, _MOST_HIGH, _LEAST_HIGH = 33, 15, 4  # characters of the table: width, and greatest and least height
_HALF_MM: Final = 200.0  # from the middle of the table to its edge, along X and Y
_TOP_MM: Final = 300.0  # greatest height of the hand
_AROUND: Final = 4  # rows of the drawing above and below the table
_NAMED: Final = 3  # positions named below the table, at most
_OPEN, _CLOSED = "O", "@"


def table_view(
    here: Place, positions: Mapping[str, Position], symbols: Symbols, rows: int, *, closed: bool
) -> list[Line]:
    """Return the drawing, with at most `rows` lines; empty if there is no room for it.

    The table is seen from above, with X to the right and Y upwards. The hand is `O`, or `@` if it is closed. Each
    position that the program names is shown by its first letter. A scale at the right shows the height of the hand.
    """
    named = [(name, place.data) for name, place in positions.items() if is_named(name) and not place.relative]
    room = rows - _AROUND
    if room < _LEAST_HIGH:
        return []
    high = max(min(_MOST_HIGH, room - _NAMED), _LEAST_HIGH)
    height = here.measures()[2]
    cells = [[" "] * _WIDE for _ in range(high)]
    for name, place in named:
        _mark(cells, place, name[0])
    hand = _CLOSED if closed else _OPEN
    row, column = _mark(cells, here, hand)
    level = round((1 - min(max(height / _TOP_MM, 0.0), 1.0)) * (high - 1))
    edge = symbols.line * _WIDE
    drawn: list[Line] = [
        [("title", "Table"), ("line", f" from above, mm{'height':>{_WIDE - 14}}")],
        [("line", f"+{edge}+")],
    ]
    for number, cell in enumerate(cells):
        text = "".join(cell)
        line: Line = [("line", symbols.stem)]
        line += [("position", text)] if number != row else [
            ("position", text[:column]), ("active", hand), ("position", text[column + 1 :]),
        ]  # fmt: skip
        scale = f"{hand} {height:.0f}" if number == level else symbols.stem
        end = {0: f"{_TOP_MM:.0f}", high - 1: "0"}.get(number, "")
        line += [("line", f"{symbols.stem} {end:>3} "), ("hand" if number == level else "line", scale)]
        drawn.append(line)
    drawn += [
        [("line", f"+{edge}+")],
        [("line", f"{AXES[0]} -200{'X 200':>{_WIDE - 4}}")],
    ]
    drawn += [
        [
            ("position", f" {name[0]}  {name[:14]:<14}"),
            ("line", " X {:.4g} Y {:.4g} Z {:.4g}".format(*place.measures())),
        ]
        for name, place in named[::-1][: min(_NAMED, room - high)]
    ]
    return [fitted(line, WIDTH - 1) for line in drawn]


def _mark(cells: list[list[str]], place: Place, mark: str) -> tuple[int, int]:
    """Write a character at a place on the table. Places beyond the edge are shown at the edge. Returns the row and
    column of the character.
    """
    x, y, *_ = place.measures()
    column, row = (
        min(max(round((value / _HALF_MM + 1) / 2 * (count - 1)), 0), count - 1)
        for value, count in ((x, _WIDE), (-y, len(cells)))
    )
    cells[row][column] = mark
    return row, column
