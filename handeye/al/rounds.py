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
    circles, moves = graph.circles(), set(graph.which(op.Move))
    searches, assigns = set(graph.which(op.Search)), _assigns(graph)
    for jump in graph.which(op.Advance, op.Countdown):
        step, again = graph.steps[jump], circles[jump]
        target, begins = step.next, searches
        if isinstance(step.operation, op.Countdown):
            target, begins = step.operation.positive, assigns.get(step.operation.counter, set())
        if target is None or target not in again:
            continue
        if not graph.leads(target, jump, without=begins):
            yield Stale(jump, min(again & begins))
        elif isinstance(step.operation, op.Advance) and again.isdisjoint(moves):
            yield Stale(jump, None)


def _assigns(graph: Graph) -> dict[str, set[int]]:
    """The steps that set each counter."""
    found: dict[str, set[int]] = {}
    for number in graph.which(op.Assign):
        operation = graph.steps[number].operation
        assert isinstance(operation, op.Assign)
        found.setdefault(operation.counter, set()).add(number)
    return found
