"""The graph of a program's steps, with its loops and deletions. The sons of a step are the one or two steps that may
follow it. Its fathers are the steps that lead to it; their number is not limited.

One of the edges that lead to a step is the step's own edge, which determines where the step is drawn. All other edges
to the step are links. Together, the steps' own edges form a tree that starts at the top and contains every step. A
loop has a partner, called a bloop, above its target step. The bloop is needed to run the loop backwards. If several
loops return to one step, the nearest loop below the step owns the nearest bloop above the step. The order in which the
loops were made does not matter.
"""

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, Literal, get_args

from handeye.core.errors import Refused
from handeye.core.record import Vector3

NodeType = Literal["top", "none", "normal", "guarded", "grasp", "ungrasp", "savpos", "loop", "bloop"]
TYPES: Final[tuple[NodeType, ...]] = get_args(NodeType)
TOP: Final = 0  # id of the node above the first step
NONE: Final = -1  # son of a branch that ends
NORMAL: Final = 0  # branch of a completed move, and the only one of other steps
GUARDED: Final = 1  # branch of a move stopped by a force
UNNAMED: Final = "***"  # shown for a step without a name
TOP_NAME: Final = "**TOP**"


@dataclass(slots=True, kw_only=True, eq=False)
class Node:
    """A step of the program, as a node of the graph. Only the methods of `Graph` change the edges of a node."""

    id: int
    type: NodeType
    name: str | None = None
    position: str | None = None
    negate: bool = False  # opposite of its relative position
    threshold: float | None = None  # N; a greater weighted force stops a guarded move
    vector: Vector3 | None = None  # weights of the finger force along the arm's X, Y and Z
    partner: int = NONE  # bloop of a loop, loop of a bloop
    wanted: int = 0  # rounds of a loop
    count: int = 0  # rounds done
    sons: list[int] = field(default_factory=lambda: [NONE])  # one per branch
    links: set[int] = field(default_factory=set)  # branches to a step drawn elsewhere
    fathers: list[int] = field(default_factory=list)
    last_father: int = NONE  # the last active one, in a run or in editing
    comment: str | None = None
    unread: Mapping[str, object] = field(default_factory=dict)  # file fields unknown to this version

    @property
    def shown(self) -> bool:
        """True if the step is visible: neither a bloop nor an end."""
        return self.type not in ("top", "none", "bloop")

    @property
    def moves(self) -> bool:
        return self.type in ("normal", "guarded")

    @property
    def recent_father(self) -> int:
        """The father that was active most recently. If that father is unknown, the newest father."""
        if self.last_father in self.fathers:
            return self.last_father
        return self.fathers[-1] if self.fathers else NONE


class Graph:
    """Nodes by number, and the edges between them."""

    def __init__(self) -> None:
        self.nodes: dict[int, Node] = {TOP: Node(id=TOP, type="top")}
        self._next = TOP + 1

    def __getitem__(self, id: int) -> Node:
        return self.nodes[id]

    def __contains__(self, id: int) -> bool:
        return id in self.nodes

    # -- looking ---------------------------------------------------------------------------------------

    def order(self) -> list[int]:
        """Return all nodes in drawing order. Each node comes before the sons that are drawn below it, and the normal
        son before the guarded son.
        """
        found, waiting = [], [TOP]
        while waiting:
            id = waiting.pop()
            found.append(id)
            node = self[id]
            own = [s for branch, s in enumerate(node.sons) if s != NONE and branch not in node.links]
            waiting.extend(reversed(own))
        return found

    def steps(self) -> Iterator[Node]:
        """Yield the visible steps in drawing order."""
        return (self[id] for id in self.order() if self[id].shown)

    def named(self, name: str) -> Node | None:
        return next((node for node in self.nodes.values() if node.name == name), None)

    def edges_into(self, id: int) -> list[tuple[int, int]]:
        """Return the fathers of a node, each with the branch that leads to the node."""
        return [(f, branch) for f in self[id].fathers for branch, son in enumerate(self[f].sons) if son == id]

    def distances(self, start: int) -> dict[int, int]:
        """Return the nodes that can be reached downwards from a node, with their distances (number of edges)."""
        found, waiting = {start: 0}, deque([start])
        while waiting:
            id = waiting.popleft()
            for son in self[id].sons:
                if son != NONE and son not in found:
                    found[son] = found[id] + 1
                    waiting.append(son)
        return found

    def step_at(self, id: int) -> int:
        """Return this node or, if it is a bloop, the first node below it that is not a bloop. Returns NONE if there is
        no such node.
        """
        while id != NONE and self[id].type == "bloop":
            id = self[id].sons[0]
        return id

    def entry(self, id: int) -> int:
        """Return the node through which a run enters a step: the uppermost bloop above the step, or the step
        itself."""
        while len(self[id].fathers) == 1 and self[self[id].fathers[0]].type == "bloop":
            id = self[id].fathers[0]
        return id

    def target(self, loop: Node) -> Node | None:
        """Return the step to which a loop returns, or None if there is no such step."""
        id = self.step_at(loop.partner)
        return None if id == NONE else self[id]

    def fill(self, nodes: Sequence[Node]) -> None:
        """Replace all nodes by the nodes of a file."""
        self.nodes = {node.id: node for node in nodes}
        self._next = max(self.nodes) + 1
        for node in nodes:
            if node.type == "loop" and node.partner in self:
                self[node.partner].partner = node.id

    # -- changing --------------------------------------------------------------------------------------

    def new(self, type: NodeType) -> Node:
        """Make a new node that is not connected yet."""
        self._next += 1
        return Node(id=self._next - 1, type=type, sons=[NONE, NONE] if type == "guarded" else [NONE])

    def attach(self, father: int, branch: int, son: int, *, link: bool = False) -> None:
        """Make the node `son` the son of the node `father` on a branch. It replaces the present son on this branch."""
        node = self[father]
        before, node.sons[branch] = node.sons[branch], son
        node.links.discard(branch)
        if before in self and before not in node.sons:
            self[before].fathers.remove(father)
        if son == NONE:
            return
        if link:
            node.links.add(branch)
        if father not in self[son].fathers:
            self[son].fathers.append(father)
        self[son].last_father = father

    def insert(self, after: int, branch: int, node: Node) -> None:
        """Insert a node on a branch of another node. The present son on this branch becomes the son of the new node.
        If the new node is guarded, the son is placed on the normal branch of the new node.
        """
        self.nodes[node.id] = node
        son = self[after].sons[branch]
        self.attach(after, branch, node.id)
        self.attach(node.id, 0, son)

    def insert_above(self, below: int, node: Node) -> None:
        """Insert `node` above node `below`. All edges that led to `below`, including links, then lead to `node`."""
        self.nodes[node.id] = node
        for father, branch in self.edges_into(below):
            self.attach(father, branch, node.id, link=branch in self[father].links)
        self.attach(node.id, 0, below)

    def drop(self, id: int) -> None:
        """Remove a node that is no longer a son of any node."""
        for branch in range(len(self[id].sons)):
            self.attach(id, branch, NONE)
        del self.nodes[id]


def insert_loop(graph: Graph, after: int, branch: int, target: int, wanted: int) -> Node:
    """Insert a loop below a node, and the loop's bloop above the target. Raises Refused if the target is not above the
    node.
    """
    if after not in graph.distances(target):
        raise Refused(
            f"{graph[target].name} is not above the active step, and a loop must go back; to link to a step below, "
            "use `L`"
        )
    loop, bloop = graph.new("loop"), graph.new("bloop")
    loop.partner, bloop.partner, loop.wanted = bloop.id, loop.id, wanted
    graph.insert(after, branch, loop)
    graph.insert_above(_innermost(graph, target, loop), bloop)
    return loop


def _innermost(graph: Graph, target: int, loop: Node) -> int:
    """Return the node above which the bloop of `loop` is inserted. If other loops are nearer to the target, this node
    is the highest of their bloops. If no loop is nearer, it is the target.
    """
    below = graph.distances(target)
    place, bloops = target, _bloops_above(graph, target)
    for bloop in bloops:
        if below.get(graph[bloop].partner, -1) > below[loop.id]:
            break
        place = bloop
    return place


def _bloops_above(graph: Graph, target: int) -> list[int]:
    found, id, top = [], target, graph.entry(target)
    while id != top:
        id = graph[id].fathers[0]
        found.append(id)
    return found


def delete_step(graph: Graph, id: int, keep: int = NORMAL) -> None:
    """Delete one step. The son on branch `keep` becomes a son of the step's fathers; the steps on the other
    branch are deleted too."""
    _take_out(graph, id, keep)
    prune(graph)


def delete_below(graph: Graph, id: int) -> None:
    """Delete a step, and all nodes that can be reached only through it."""
    for father, branch in graph.edges_into(id):
        graph.attach(father, branch, NONE)
    graph.drop(id)
    prune(graph)


def prune(graph: Graph) -> None:
    """Remove unreachable nodes, and loops that are separated from their bloops. Then restore the tree."""
    while True:
        reached = graph.distances(TOP)
        for lost in [id for id in graph.nodes if id not in reached]:
            graph.drop(lost)
        broken = next((node for node in graph.nodes.values() if _is_cut(graph, node)), None)
        if broken is None:
            break
        _take_out(graph, broken.id, NORMAL)
    _mend_tree(graph)


def _take_out(graph: Graph, id: int, keep: int) -> None:
    node = graph[id]
    son = NONE if node.sons[keep] == id else node.sons[keep]
    for father, branch in graph.edges_into(id):
        link = branch in graph[father].links or keep in node.links
        graph.attach(father, branch, son, link=link)
    graph.drop(id)


def _is_cut(graph: Graph, node: Node) -> bool:
    """Return True if a loop or bloop has lost its partner, or if no path leads from the bloop to the loop."""
    if node.type not in ("loop", "bloop"):
        return False
    if node.partner not in graph:
        return True
    return node.type == "bloop" and node.partner not in graph.distances(node.id)


def _mend_tree(graph: Graph) -> None:
    """Give every node exactly one incoming edge that is not a link. If a node already has such an edge, and this edge
    is still connected to the top, the node keeps it.
    """
    placed = {TOP}
    _follow(graph, TOP, placed)
    while len(placed) < len(graph.nodes):
        father, branch = next(
            (id, branch)
            for id in graph.order()
            for branch, son in enumerate(graph[id].sons)
            if son != NONE and son not in placed
        )
        graph[father].links.discard(branch)
        son = graph[father].sons[branch]
        placed.add(son)
        _follow(graph, son, placed)


def _follow(graph: Graph, start: int, placed: set[int]) -> None:
    """From a node, follow the edges that are not links, and place all nodes to which these edges lead. An edge to a
    node that is already placed becomes a link.
    """
    waiting = [start]
    while waiting:
        node = graph[waiting.pop()]
        for branch, son in enumerate(node.sons):
            if son == NONE or branch in node.links:
                continue
            if son in placed:
                node.links.add(branch)
            else:
                placed.add(son)
                waiting.append(son)
