"""Invariants of programs, checked for every file."""

import re
from collections import Counter
from collections.abc import Iterator

from handeye.systems.trig.language.graph import Graph
from handeye.systems.trig.language.node import NONE, TOP, Node
from handeye.systems.trig.language.position import LONGEST, NAME, Positions


def faults(graph: Graph, positions: Positions) -> Iterator[str]:
    """Violations of invariants in words; none if the program is sound."""
    torn = list(_edge_faults(graph))
    if not torn and not _has_tree(graph):
        torn = ["its steps do not hang together from the top"]
    yield from torn
    if not torn:
        yield from _loop_faults(graph)
    for node in graph.nodes.values():
        yield from _step_faults(node, positions)
    names = Counter(node.name for node in graph.nodes.values() if node.name is not None)
    yield from (f"two steps are called {name}" for name, count in names.items() if count > 1)


def _edge_faults(graph: Graph) -> Iterator[str]:
    for id, node in graph.nodes.items():
        if node.type == "none" or (node.type == "top") != (id == TOP):
            yield f"step {id} is no step, but {node.type}"
        if len(node.sons) != (2 if node.type == "guarded" else 1):
            yield f"step {id} is {node.type} and has {len(node.sons)} sons"
        for son in node.sons:
            if son != NONE and (son not in graph or son == TOP):
                yield f"step {id} has a son {son} that there is not"
            elif son != NONE and id not in graph[son].fathers:
                yield f"step {son} does not know its father {id}"
        for father in node.fathers:
            if father not in graph or id not in graph[father].sons:
                yield f"step {id} has a father {father} who does not know it"
        if any(not 0 <= branch < len(node.sons) or node.sons[branch] == NONE for branch in node.links):
            yield f"step {id} has a link that leads nowhere"
    if graph[TOP].fathers:
        yield "something leads up to the top"


def _has_tree(graph: Graph) -> bool:
    """True if the own edges form a tree of all nodes."""
    seen, waiting = {TOP}, [TOP]
    while waiting:
        node = graph[waiting.pop()]
        for branch, son in enumerate(node.sons):
            if son == NONE or branch in node.links:
                continue
            if son in seen or son not in graph:
                return False
            seen.add(son)
            waiting.append(son)
    return len(seen) == len(graph.nodes)


def _loop_faults(graph: Graph) -> Iterator[str]:
    for id, node in graph.nodes.items():
        if node.type not in ("loop", "bloop"):
            continue
        partner = graph.nodes.get(node.partner)
        if partner is None or partner.partner != id or {node.type, partner.type} != {"loop", "bloop"}:
            yield f"the {node.type} {id} has no partner"
        elif node.type == "bloop" and node.partner not in graph.distances(id):
            yield f"the loop {node.partner} does not stand below where it goes back to"
        if not 0 <= node.count <= node.wanted:
            yield f"the loop {id} has gone back {node.count} times of {node.wanted}"


def _step_faults(node: Node, positions: Positions) -> Iterator[str]:
    if node.name is not None and not (re.fullmatch(NAME, node.name) and len(node.name) <= LONGEST):
        yield f"step {node.id} has a name that is none"
    if node.name is not None and (not node.shown or node.type == "loop"):
        yield f"step {node.id} is a {node.type} and has a name"
    position = positions.get(node.position or "")
    if (node.type in ("normal", "guarded", "savpos")) != (position is not None):
        yield f"step {node.id} is {node.type} and {'has a' if position else 'lacks its'} position"
    elif position is not None and position.relative and node.type == "savpos":
        yield f"step {node.id} saves a relative position"
    elif position is not None and node.negate and not position.relative:
        yield f"step {node.id} goes the other way of an absolute position"
    if (node.type == "guarded") != (node.threshold is not None and node.vector is not None):
        yield f"step {node.id} is {node.type}, and threshold and force vector do not fit that"
    if node.threshold is not None and not node.threshold >= 0:
        yield f"step {node.id} has a threshold below 0"
