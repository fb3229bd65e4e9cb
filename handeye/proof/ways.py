"""Searches for a path that reaches the end without showing a claim. If the program has no UNDO, the search follows the
values of counters exactly. If it has one, the search ignores these values, because a reversal restores them.
"""

from collections import deque
from typing import Final, NamedTuple

from handeye.program.flow_operations import Assign, Countdown, Undo
from handeye.proof.outcomes import END, Edge, OutcomeGraph
from handeye.proof.progress import Effects

MOST: Final = 400_000  # states of one search

Counters = tuple[tuple[str, int], ...]


class _State(NamedTuple):
    node: int
    counters: Counters
    shown: int


class Leg(NamedTuple):
    """One node of a path, and the number of the edge by which the path leaves it."""

    node: int
    edge: int


class TooMany(Exception):
    """Raised when a search has reached its greatest number of states."""


def way_without(graph: OutcomeGraph, effects: Effects, live: list[frozenset[str]]) -> list[Leg] | None:
    """Return a shortest path that reaches the end without showing all phases of a claim; None if there is no such path.

    Raises:
        TooMany: the search has become too large.
    """
    if not graph.nodes:
        return None
    first = _State(0, (), effects.first)
    before: dict[_State, tuple[_State, int] | None] = {first: None}
    waiting = deque([first])
    while waiting:
        state = waiting.popleft()
        for number, edge in enumerate(graph.edges[state.node]):
            counters = _counted(graph, state, edge)
            if counters is None:
                continue
            table = effects.tables.get((state.node, number))
            shown = state.shown if table is None else table[state.shown]
            if edge.to == END:
                if shown < effects.whole:
                    return _traced(before, state, number)
                continue
            kept = tuple(item for item in counters if item[0] in live[edge.to])
            following = _State(edge.to, kept, shown)
            if following not in before:
                before[following] = state, number
                waiting.append(following)
        if len(before) > MOST:
            raise TooMany
    return None


def _counted(graph: OutcomeGraph, state: _State, edge: Edge) -> Counters | None:
    """Return the counters after an edge; None if their values forbid the edge."""
    operation = graph.step(state.node).operation
    if isinstance(operation, Assign):
        return tuple(sorted({**dict(state.counters), operation.counter: operation.value}.items()))
    if not isinstance(operation, Countdown) or Undo in graph.kinds:  # a reversal may restore a counter
        return state.counters
    left = dict(state.counters).get(operation.counter, 0) - 1
    if (left > 0) != edge.taken:
        return None
    return tuple(sorted({**dict(state.counters), operation.counter: max(left, 0)}.items()))


def _traced(before: dict[_State, tuple[_State, int] | None], state: _State, edge: int) -> list[Leg]:
    way = [Leg(state.node, edge)]
    while (link := before[state]) is not None:
        state, number = link
        way.append(Leg(state.node, number))
    return way[::-1]
