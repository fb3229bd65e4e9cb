"""Loops that search or count, and try the same again in every round."""

from collections.abc import Iterator
from dataclasses import dataclass

from handeye.al.graph import Graph
from handeye.plan import program as op


@dataclass(frozen=True, slots=True)
class Stale:
    """A jump back to a round like the one before."""

    jump: int
    """The step that jumps back."""
    cause: int | None
    """The step that begins the search or the count anew; None: nothing moves to the next place."""


def stale_rounds(graph: Graph) -> Iterator[Stale]:
    """The jumps of searches and counts that cannot come to an end by themselves."""
    for jump in graph.which(op.Advance, op.Countdown):
        step = graph.steps[jump]
        if isinstance(step.operation, op.Countdown):
            target, begins, moves = step.operation.positive, _assigns(graph, step.operation.counter), None
        else:
            target, begins, moves = step.next, graph.which(op.Search), graph.which(op.Move)
        again = graph.between(target, jump)
        if not again:
            continue
        if not graph.between(target, jump, without=begins):
            yield Stale(jump, min(again.intersection(begins)))
        elif moves is not None and again.isdisjoint(moves):
            yield Stale(jump, None)


def _assigns(graph: Graph, counter: str) -> list[int]:
    """The steps that set a counter."""
    steps = ((number, graph.steps[number].operation) for number in graph.which(op.Assign))
    return [number for number, step in steps if isinstance(step, op.Assign) and step.counter == counter]
