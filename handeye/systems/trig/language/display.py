"""Draws the two displays of a program, which share a layout.

In the layout, a chain of steps is a column. A guarded step has two sons. The normal son stands below the step in the
same column. The guarded son is one row below the step too, but it begins a column farther right. The lines that lead
to these columns never cross, because the chains of later guarded steps are placed first. The full display shows the
program in miniature: one character per step, with the active step in brackets. The full display exchanges rows and
columns of the layout, because a screen is wider than high: a chain there runs from left to right. The partial display
shows the active step and the steps around it, one row per step, in as much detail as fits.
"""

from dataclasses import dataclass, field
from typing import Final

from handeye.systems.trig.language.graph import (
    GUARDED,
    NONE,
    NORMAL,
    TOP,
    TOP_NAME,
    UNNAMED,
    Graph,
    Node,
    NodeType,
)
from handeye.systems.trig.language.place import Positions, is_named
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.styled import UNICODE, Line, Style, Symbols, fitted, plain


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """A step at its place on the display, or a link to a step whose place is elsewhere. For the first step of a
    branch, `branch` is `n` (normal) or `g` (guarded). For all other steps, `branch` is empty.
    """

    row: int
    column: int
    node: Node
    link: bool = False
    branch: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Elbow:
    """The line from a guarded step to its guarded son, which is in another column."""

    row: int
    start: int
    end: int


@dataclass(slots=True)
class _Chain:
    """A chain of steps, with the chains to its right. The keys of `hung` and `shift` are the rows of the guarded
    steps. For each such step, `hung` gives the chain that begins with the step's guarded son. `shift` gives the number
    of columns from the step to that chain.
    """

    items: list[tuple[Node, bool, str]] = field(default_factory=list)
    hung: dict[int, "_Chain"] = field(default_factory=dict)
    shift: dict[int, int] = field(default_factory=dict)
    height: int = 0
    width: int = 1


@dataclass(frozen=True, slots=True)
class Layout:
    """The places of a program's steps on a display, and the lines between them."""

    cells: tuple[Cell, ...]
    elbows: tuple[Elbow, ...]

    @property
    def rows(self) -> int:
        return 1 + max((cell.row for cell in self.cells), default=-1)

    @property
    def columns(self) -> int:
        return 1 + max((cell.column for cell in self.cells), default=-1)


def layout(graph: Graph, *, top: bool = False) -> Layout:
    """Place all steps of a program, except bloops. If `top` is True, also place the top of the program."""
    chains = _chains(graph, top=top)
    for chain in reversed(chains):
        _measure(chain)
    return _placed(chains[0])


def _chains(graph: Graph, *, top: bool) -> list[_Chain]:
    """Return all chains. Each chain comes before the chains that are attached to it."""
    first = _Chain(items=[(graph[TOP], False, "")] if top else [])
    found, waiting = [], [(first, TOP, NORMAL, "")]
    while waiting:
        chain, id, branch, letter = waiting.pop()
        found.append(chain)
        while (son := graph[id].sons[branch]) != NONE:
            link = branch in graph[id].links or _is_link_behind(graph, son)
            step = graph.step_at(son)
            if step == NONE:
                break
            chain.items.append((graph[step], link, letter))
            if link:
                break
            id, branch, letter = step, NORMAL, "n" if graph[step].type == "guarded" else ""
            if graph[id].type == "guarded" and graph[id].sons[GUARDED] != NONE:
                chain.hung[len(chain.items) - 1] = hung = _Chain()
                waiting.append((hung, id, GUARDED, "g"))
    return found


def _is_link_behind(graph: Graph, id: int) -> bool:
    """Follow the bloops that begin at node `id`. Return True if a link leads out of one of them."""
    while graph[id].type == "bloop":
        if graph[id].links:
            return True
        id = graph[id].sons[NORMAL]
        if id == NONE:
            return False
    return False


def _measure(chain: _Chain) -> None:
    """Compute the size of a chain with all its attached chains. The chain that is attached lowest is placed nearest to
    `chain`.
    """
    chain.height = len(chain.items)
    below: list[tuple[int, int]] = []
    for row in sorted(chain.hung, reverse=True):
        hung = chain.hung[row]
        beside = (right for first, right in below if first <= row + hung.height)
        chain.shift[row] = max(beside, default=1)
        below.append((row, chain.shift[row] + hung.width))
        chain.height = max(chain.height, row + 1 + hung.height)
        chain.width = max(chain.width, chain.shift[row] + hung.width)


def _placed(first: _Chain) -> Layout:
    cells, elbows, waiting = [], [], [(first, 0, 0)]
    while waiting:
        chain, row, column = waiting.pop()
        for below, (node, link, branch) in enumerate(chain.items):
            cells.append(Cell(row=row + below, column=column, node=node, link=link, branch=branch))
        for below, hung in chain.hung.items():
            right = column + chain.shift[below]
            elbows.append(Elbow(row=row + below, start=column, end=right))
            waiting.append((hung, row + below + 1, right))
    return Layout(tuple(cells), tuple(elbows))


SIGNS: Final[dict[NodeType, str]] = {
    "top": "*", "normal": "o", "guarded": "<", "grasp": "c", "ungrasp": "u", "savpos": "=", "loop": "@"
}  # fmt: skip
LINK: Final = "^"
_STYLES: Final[dict[str, Style]] = {"c": "hand", "u": "hand", "<": "guarded", "@": "loop", LINK: "link"}

_Grid = dict[tuple[int, int], tuple[Style, str]]  # by row and column


def full_display(program: TrigProgram, width: int, height: int, symbols: Symbols = UNICODE) -> list[Line]:
    """Draw the whole program. If it does not fit, draw only the part around the active step."""
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
        row, column = active.column, 2 * active.row
        grid[row, column - 1], grid[row, column + 1] = ("active", "["), ("active", "]")
        grid[row, column] = ("active", grid[row, column][1])
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


def _line(grid: _Grid, row: int, left: int, width: int, symbols: Symbols) -> Line:
    """Return one line of the display. A mark at an end of the line shows that the program continues beyond that end."""
    last = max((x for y, x in grid if y == row), default=-2)
    line = [grid.get((row, x), ("", " ")) for x in range(left, min(last, left + width - 1) + 1)]
    if line and left > -1 and any((row, x) in grid for x in range(left)):
        line[0] = ("line", symbols.more)
    if line and last >= left + width:
        line[-1] = ("line", symbols.more)
    return line


NO_POSITION: Final = "- -"  # for a position without a name
GUARD: Final = " G"  # after the position of a guarded step
MAX_NAME_CHARS: Final = 16  # characters of a name before it is cut
_STEP_STYLES: Final = {"guarded": "guarded", "normal": "position", "savpos": "position"}


def step_words(graph: Graph, positions: Positions, cell: Cell, symbols: Symbols) -> tuple[str, str, Style]:
    """Return the name of a step, its action, and the style of the action. If the name already says everything, the
    action is empty, and the returned style is the style of the name.
    """
    node = cell.node
    if cell.link:
        return f"[{_cut(node.name or UNNAMED, symbols)}]", "", "link"
    if node.type == "top":
        return TOP_NAME.lower(), "", "name"
    if node.type == "loop":
        return f"{loop_words(graph, node, symbols)} ({node.count})", "", "loop"
    name = _cut(node.name or UNNAMED, symbols)
    return name, _deed(node, positions, symbols), _STEP_STYLES.get(node.type, "hand")


def loop_words(graph: Graph, node: Node, symbols: Symbols) -> str:
    """Return a loop as users type it: the target step and the count."""
    target = graph.target(node)
    name = UNNAMED if target is None else target.name or UNNAMED
    return f"LOOP {_cut(name, symbols)} {node.wanted}"


def _deed(node: Node, positions: Positions, symbols: Symbols) -> str:
    if node.position is None:
        return f"({node.type})"
    name = _cut(node.position, symbols) if is_named(node.position) else NO_POSITION
    saves = "=" if node.type == "savpos" else ""
    minus = "-" if node.negate else ""
    sign = "#" if positions[node.position].relative else ""
    guard = GUARD if node.type == "guarded" else ""
    return f"{saves}{minus}{sign}{name}{guard}"


def _cut(name: str, symbols: Symbols) -> str:
    return name if len(name) <= MAX_NAME_CHARS else name[: MAX_NAME_CHARS - 1] + symbols.more


_MIN_COLUMN: Final = 18  # characters
_GAP: Final = 2  # characters between columns
_MARKER: Final = 3  # characters before a name: cursor and branch


@dataclass(frozen=True, slots=True, kw_only=True)
class _Pane:
    """The visible part of a program: widths in characters, cells by row and column, and elbows by row."""

    program: TrigProgram
    symbols: Symbols
    name: int
    column: int
    cells: dict[tuple[int, int], Cell]
    elbows: dict[int, Elbow]


def partial_display(program: TrigProgram, width: int, height: int, symbols: Symbols = UNICODE) -> list[Line]:
    """Draw as many steps as fit, including the active step and one step above it."""
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
    """Return the first visible row, chosen so that the active row is visible with some rows above it."""
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
    line: Line = []
    for column in columns:
        cell = pane.cells.get((row, column))
        pieces = [] if cell is None else _pieces(pane, cell)
        room = pane.column + _GAP - len(plain([pieces]))
        line += [*pieces, _filled(room, column, pane.elbows.get(row), pane.symbols)]
    return line


def _filled(room: int, column: int, elbow: Elbow | None, symbols: Symbols) -> tuple[Style, str]:
    """Return the text after a step: blanks, or the line to the right."""
    if elbow is None or not elbow.start <= column <= elbow.end:
        return "", " " * room
    if column == elbow.end:
        return "line", (symbols.line * _MARKER + symbols.corner).ljust(room)
    return "line", " " + symbols.line * (room - 1)


def _pieces(pane: _Pane, cell: Cell) -> Line:
    name, deed, style = step_words(pane.program.graph, pane.program.positions, cell, pane.symbols)
    text = f"{name:{pane.name}}  " if deed else ""
    if cell.node.id == pane.program.cursor and not cell.link:
        line = [("active", f"{pane.symbols.cursor}{cell.branch:1} {text}{deed or name}")]
    else:
        line = [("branch", f" {cell.branch:1} "), ("name", text), (style, deed or name)]
    return fitted(line, pane.column)
