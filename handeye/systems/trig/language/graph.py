"""Graph: the steps of a program, each with one or two sons and any number of fathers.

Of the edges that lead to a step one is its own, by which it is drawn; the others are links. The own edges make a tree
that begins with the top, and every step stands in it.
"""

from collections import deque
from collections.abc import Iterator, Sequence

from handeye.systems.trig.language.node import NONE, TOP, Node, NodeType


class Graph:
    """Nodes by their numbers, and the edges between them."""

    def __init__(self) -> None:
        self.nodes: dict[int, Node] = {TOP: Node(id=TOP, type="top")}
        self._next = TOP + 1

    def __getitem__(self, id: int) -> Node:
        return self.nodes[id]

    def __contains__(self, id: int) -> bool:
        return id in self.nodes

    # -- looking ---------------------------------------------------------------------------------------

    def order(self) -> list[int]:
        """All nodes as they are drawn: each before its own sons, the normal son before the guarded one."""
        found, waiting = [], [TOP]
        while waiting:
            id = waiting.pop()
            found.append(id)
            node = self[id]
            own = [s for branch, s in enumerate(node.sons) if s != NONE and branch not in node.links]
            waiting.extend(reversed(own))
        return found

    def steps(self) -> Iterator[Node]:
        """The steps that people see, as they are drawn."""
        return (self[id] for id in self.order() if self[id].shown)

    def named(self, name: str) -> Node | None:
        """The step of a name."""
        return next((node for node in self.nodes.values() if node.name == name), None)

    def edges_into(self, id: int) -> list[tuple[int, int]]:
        """Fathers of a node, and the branches on which it is their son."""
        return [(f, branch) for f in self[id].fathers for branch, son in enumerate(self[f].sons) if son == id]

    def distances(self, start: int) -> dict[int, int]:
        """All nodes that can be reached from one by going down, with the number of edges on the way."""
        found, waiting = {start: 0}, deque([start])
        while waiting:
            id = waiting.popleft()
            for son in self[id].sons:
                if son != NONE and son not in found:
                    found[son] = found[id] + 1
                    waiting.append(son)
        return found

    def step_at(self, id: int) -> int:
        """The first step from a node on downwards that is no bloop; NONE: there is none."""
        while id != NONE and self[id].type == "bloop":
            id = self[id].sons[0]
        return id

    def entry(self, id: int) -> int:
        """The node by which a step is entered: the uppermost of the bloops that stand above it, or the step."""
        while len(self[id].fathers) == 1 and self[self[id].fathers[0]].type == "bloop":
            id = self[id].fathers[0]
        return id

    def target(self, loop: Node) -> Node | None:
        """The step that a loop goes back to."""
        id = self.step_at(loop.partner)
        return None if id == NONE else self[id]

    def fill(self, nodes: Sequence[Node]) -> None:
        """Take the nodes of a file in the place of its own."""
        self.nodes = {node.id: node for node in nodes}
        self._next = max(self.nodes) + 1
        for node in nodes:
            if node.type == "loop" and node.partner in self:
                self[node.partner].partner = node.id

    # -- changing --------------------------------------------------------------------------------------

    def new(self, type: NodeType) -> Node:
        """A node that hangs together with none yet."""
        self._next += 1
        return Node(id=self._next - 1, type=type, sons=[NONE, NONE] if type == "guarded" else [NONE])

    def attach(self, father: int, branch: int, son: int, *, link: bool = False) -> None:
        """Make a node the son of another on one of its branches, in the place of the one it has there."""
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
        """Put a new node below another. What stood there becomes its son, its normal son if it is guarded."""
        self.nodes[node.id] = node
        son = self[after].sons[branch]
        self.attach(after, branch, node.id)
        self.attach(node.id, 0, son)

    def insert_above(self, below: int, node: Node) -> None:
        """Put a new node between another and all of its fathers, links included."""
        self.nodes[node.id] = node
        for father, branch in self.edges_into(below):
            self.attach(father, branch, node.id, link=branch in self[father].links)
        self.attach(node.id, 0, below)

    def drop(self, id: int) -> None:
        """Take a node out that is nobody's son any more."""
        for branch in range(len(self[id].sons)):
            self.attach(id, branch, NONE)
        del self.nodes[id]
