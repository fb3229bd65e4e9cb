"""Deletion: what goes with a step, and how what stays hangs together."""

from handeye.systems.trig.language.graph import Graph
from handeye.systems.trig.language.node import NONE, NORMAL, TOP, Node


def delete_step(graph: Graph, id: int, keep: int = NORMAL) -> None:
    """Delete one step; each father adopts the son that is kept. What hangs on its other branch goes with it."""
    _take_out(graph, id, keep)
    prune(graph)


def delete_below(graph: Graph, id: int) -> None:
    """Delete a step, and every node that can only be reached through it."""
    for father, branch in graph.edges_into(id):
        graph.attach(father, branch, NONE)
    graph.drop(id)
    prune(graph)


def prune(graph: Graph) -> None:
    """Drop what cannot be reached from the top, and loops that have been cut from their bloops; then make the
    tree whole again."""
    while True:
        _drop_unreached(graph)
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


def _drop_unreached(graph: Graph) -> None:
    reached = graph.distances(TOP)
    lost = [id for id in graph.nodes if id not in reached]
    for id in lost:
        graph.drop(id)


def _is_cut(graph: Graph, node: Node) -> bool:
    """Whether a loop or bloop has lost its partner, or no way leads from the bloop to the loop."""
    if node.type not in ("loop", "bloop"):
        return False
    if node.partner not in graph:
        return True
    return node.type == "bloop" and node.partner not in graph.distances(node.id)


def _mend_tree(graph: Graph) -> None:
    """Give every node exactly one edge that is no link: its old one where that still hangs on the top."""
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
    """Place what hangs below a node by edges of its own; an edge to what is placed already becomes a link."""
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
