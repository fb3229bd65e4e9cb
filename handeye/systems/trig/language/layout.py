"""Layout of a drawn program.

A chain of steps is a column. The normal son of a guarded step stands below it, in its column; the guarded son begins a
column farther right, a row below. Columns never cross: the chains of later guarded steps are placed first.
"""

from dataclasses import dataclass, field

from handeye.systems.trig.language.graph import GUARDED, NONE, NORMAL, TOP, Graph, Node


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """A placed step, or a link to one placed elsewhere; `branch` is `n` or `g` on a branch's first step."""

    row: int
    column: int
    node: Node
    link: bool = False
    branch: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Elbow:
    """The line from a guarded step to its guarded son's column."""

    row: int
    start: int
    end: int


@dataclass(slots=True)
class _Chain:
    """A chain of steps, with the chains to its right by the row of their guarded step, and their column offsets."""

    items: list[tuple[Node, bool, str]] = field(default_factory=list)
    hung: dict[int, "_Chain"] = field(default_factory=dict)
    shift: dict[int, int] = field(default_factory=dict)
    height: int = 0
    width: int = 1


@dataclass(frozen=True, slots=True)
class Layout:
    """A placed program."""

    cells: tuple[Cell, ...]
    elbows: tuple[Elbow, ...]

    @property
    def rows(self) -> int:
        return 1 + max((cell.row for cell in self.cells), default=-1)

    @property
    def columns(self) -> int:
        return 1 + max((cell.column for cell in self.cells), default=-1)


def layout(graph: Graph, *, top: bool = False) -> Layout:
    """Place all steps of a program, and optionally the top; bloops are not drawn."""
    chains = _chains(graph, top=top)
    for chain in reversed(chains):
        _measure(chain)
    return _placed(chains[0])


def _chains(graph: Graph, *, top: bool) -> list[_Chain]:
    """All chains, each before those attached to it."""
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
    """True if bloops lead from a node to a step by a link."""
    while graph[id].type == "bloop":
        if graph[id].links:
            return True
        id = graph[id].sons[NORMAL]
        if id == NONE:
            return False
    return False


def _measure(chain: _Chain) -> None:
    """Compute the size of a chain with all attached chains; later ones are nearer."""
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
