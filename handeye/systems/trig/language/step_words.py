"""Name and action of a step, as in the partial display."""

from typing import Final

from handeye.systems.trig.language.graph import Graph
from handeye.systems.trig.language.layout import Cell
from handeye.systems.trig.language.node import TOP_NAME, UNNAMED, Node
from handeye.systems.trig.language.position import Positions, is_named
from handeye.systems.trig.language.styled import Style
from handeye.systems.trig.language.symbols import Symbols

NO_POSITION: Final = "- -"  # for a position without a name
GUARD: Final = " G"  # after the position of a guarded step
LONGEST: Final = 16  # characters of a name before it is cut
_STYLES: Final = {"guarded": "guarded", "normal": "position", "savpos": "position"}


def step_words(graph: Graph, positions: Positions, cell: Cell, symbols: Symbols) -> tuple[str, str, Style]:
    """Name and action of a step, or one text for both, with its style."""
    node = cell.node
    if cell.link:
        return f"[{_cut(node.name or UNNAMED, symbols)}]", "", "link"
    if node.type == "top":
        return TOP_NAME.lower(), "", "name"
    if node.type == "loop":
        return f"{loop_words(graph, node, symbols)} ({node.count})", "", "loop"
    name = _cut(node.name or UNNAMED, symbols)
    return name, _deed(node, positions, symbols), _STYLES.get(node.type, "hand")


def loop_words(graph: Graph, node: Node, symbols: Symbols) -> str:
    """A loop as typed: target step and count."""
    target = graph.target(node)
    name = UNNAMED if target is None else target.name or UNNAMED
    return f"LOOP {_cut(name, symbols)} {node.wanted}"


def _deed(node: Node, positions: Positions, symbols: Symbols) -> str:
    """The action of a step."""
    if node.position is None:
        return f"({node.type})"
    name = _cut(node.position, symbols) if is_named(node.position) else NO_POSITION
    saves = "=" if node.type == "savpos" else ""
    minus = "-" if node.negate else ""
    sign = "#" if positions[node.position].relative else ""
    guard = GUARD if node.type == "guarded" else ""
    return f"{saves}{minus}{sign}{name}{guard}"


def _cut(name: str, symbols: Symbols) -> str:
    return name if len(name) <= LONGEST else name[: LONGEST - 1] + symbols.more
