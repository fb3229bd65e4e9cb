"""The graph of a program's steps, each with one or two sons and any number of fathers.

Of the edges to a step one is its own, by which it is drawn; the others are links. The own edges form a tree from the
top that contains every step.
"""

from collections import deque
from collections.abc import Iterator, Sequence

from handeye.systems.trig.language.node import NONE, TOP, Node, NodeType


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
        """All nodes in drawing order: each before its own sons, the normal son before the guarded one."""
        found, waiting = [], [TOP]
        while waiting:
            id = waiting.pop()
            found.append(id)
            node = self[id]
            own = [s for branch, s in enumerate(node.sons) if s != NONE and branch not in node.links]
            waiting.extend(reversed(own))
        return found

    def steps(self) -> Iterator[Node]:
        """The visible steps in drawing order."""
        return (self[id] for id in self.order() if self[id].shown)

    def named(self, name: str) -> Node | None:
        """The step of a name."""
        return next((node for node in self.nodes.values() if node.name == name), None)

    def edges_into(self, id: int) -> list[tuple[int, int]]:
        """Fathers of a node with the branches that lead to it."""
        return [(f, branch) for f in self[id].fathers for branch, son in enumerate(self[f].sons) if son == id]

    def distances(self, start: int) -> dict[int, int]:
        """Nodes reachable downwards from one, with their distance in edges."""
        found, waiting = {start: 0}, deque([start])
        while waiting:
            id = waiting.popleft()
            for son in self[id].sons:
                if son != NONE and son not in found:
                    found[son] = found[id] + 1
                    waiting.append(son)
        return found

    def step_at(self, id: int) -> int:
        """The first step downwards from a node that is no bloop, or NONE."""
        while id != NONE and self[id].type == "bloop":
            id = self[id].sons[0]
        return id

    def entry(self, id: int) -> int:
        """The node by which a step is entered: the uppermost bloop above it, or itself."""
        while len(self[id].fathers) == 1 and self[self[id].fathers[0]].type == "bloop":
            id = self[id].fathers[0]
        return id

    def target(self, loop: Node) -> Node | None:
        """The step that a loop returns to."""
        id = self.step_at(loop.partner)
        return None if id == NONE else self[id]

    def fill(self, nodes: Sequence[Node]) -> None:
        """Replace all nodes by those of a file."""
        self.nodes = {node.id: node for node in nodes}
        self._next = max(self.nodes) + 1
        for node in nodes:
            if node.type == "loop" and node.partner in self:
                self[node.partner].partner = node.id

    # -- changing --------------------------------------------------------------------------------------

    def new(self, type: NodeType) -> Node:
        """A new, unconnected node."""
        self._next += 1
        return Node(id=self._next - 1, type=type, sons=[NONE, NONE] if type == "guarded" else [NONE])

    def attach(self, father: int, branch: int, son: int, *, link: bool = False) -> None:
        """Make a node the son of another on a branch, replacing its present son there."""
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
        """Insert a node below another; the previous son becomes its own, the normal one if it is guarded."""
        self.nodes[node.id] = node
        son = self[after].sons[branch]
        self.attach(after, branch, node.id)
        self.attach(node.id, 0, son)

    def insert_above(self, below: int, node: Node) -> None:
        """Insert a node between another and all its fathers, links included."""
        self.nodes[node.id] = node
        for father, branch in self.edges_into(below):
            self.attach(father, branch, node.id, link=branch in self[father].links)
        self.attach(node.id, 0, below)

    def drop(self, id: int) -> None:
        """Remove a node that is no longer a son."""
        for branch in range(len(self[id].sons)):
            self.attach(id, branch, NONE)
        del self.nodes[id]
