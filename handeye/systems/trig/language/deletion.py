"""Deletion of steps, and repair of what remains."""

from handeye.systems.trig.language.graph import Graph
from handeye.systems.trig.language.node import NONE, NORMAL, TOP, Node


def delete_step(graph: Graph, id: int, keep: int = NORMAL) -> None:
    """Delete one step: fathers adopt the son on branch `keep`; what hangs on the other branch goes too."""
    _take_out(graph, id, keep)
    prune(graph)


def delete_below(graph: Graph, id: int) -> None:
    """Delete a step, and every node reachable only through it."""
    for father, branch in graph.edges_into(id):
        graph.attach(father, branch, NONE)
    graph.drop(id)
    prune(graph)


def prune(graph: Graph) -> None:
    """Drop unreachable nodes and loops cut from their bloops, then restore the tree."""
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
    """True if a loop or bloop has lost its partner, or no path leads from the bloop to the loop."""
    if node.type not in ("loop", "bloop"):
        return False
    if node.partner not in graph:
        return True
    return node.type == "bloop" and node.partner not in graph.distances(node.id)


def _mend_tree(graph: Graph) -> None:
    """Give every node exactly one edge that is no link: its old one where that is still connected to the top."""
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
    """Place nodes below a node along own edges; an edge to a placed node becomes a link."""
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
