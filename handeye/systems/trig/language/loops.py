"""Loops: each has a partner (bloop) above its target step, so that it can be reversed too.

Where several loops return to one step, the nearest loop below it owns the nearest bloop above it, whichever was made
first.
"""

from handeye.core.errors import Refused
from handeye.systems.trig.language.graph import Graph
from handeye.systems.trig.language.node import Node


def insert_loop(graph: Graph, after: int, branch: int, target: int, wanted: int) -> Node:
    """Insert a loop below a node, and its bloop above its target; raises Refused if that is not above."""
    if after not in graph.distances(target):
        raise Refused(
            f"{graph[target].name} does not stand above the active step, and a loop goes back: `L` leads on to it"
        )
    loop, bloop = graph.new("loop"), graph.new("bloop")
    loop.partner, bloop.partner, loop.wanted = bloop.id, loop.id, wanted
    graph.insert(after, branch, loop)
    graph.insert_above(_innermost(graph, target, loop), bloop)
    return loop


def _innermost(graph: Graph, target: int, loop: Node) -> int:
    """The node above which a loop's bloop belongs: a bloop of a nearer loop, or the target."""
    below = graph.distances(target)
    place, bloops = target, _bloops_above(graph, target)
    for bloop in bloops:
        if below.get(graph[bloop].partner, -1) > below[loop.id]:
            break
        place = bloop
    return place


def _bloops_above(graph: Graph, target: int) -> list[int]:
    """Bloops above a step, from below."""
    found, id, top = [], target, graph.entry(target)
    while id != top:
        id = graph[id].fathers[0]
        found.append(id)
    return found
