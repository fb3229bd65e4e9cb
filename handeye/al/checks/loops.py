"""Loops that search or count, and try the same again in every round."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache

from handeye.program.flow_operations import Advance, Assign, Countdown, Search
from handeye.program.graph import Graph
from handeye.program.motion_operations import Move


@dataclass(frozen=True, slots=True)
class Stale:
    """A jump back to a round like the one before."""

    jump: int
    """The step that jumps back."""
    cause: int | None
    """The step that begins the search or the count anew; None: nothing moves to the next place."""


Circles = Callable[[], list[set[int]]]


def stale_rounds(graph: Graph) -> Iterator[Stale]:
    """The jumps of searches and counts that cannot come to an end by themselves."""
    circles = cache(graph.circles)  # asked for only where something looks wrong
    searches, moves = set(graph.which(Search)), set(graph.which(Move))
    places = searches | moves
    for jump in graph.which(Advance):
        target = graph.steps[jump].next
        yield from _anew(graph, circles, jump, target, searches)
        if graph.leads(target, jump, without=places) and circles()[jump].isdisjoint(moves):
            yield Stale(jump, None)
    assigns = _assigns(graph)
    for jump, count in graph.each(Countdown):
        yield from _anew(graph, circles, jump, count.positive, assigns.get(count.counter, set()))


def _anew(graph: Graph, circles: Circles, jump: int, target: int | None, begins: set[int]) -> Iterator[Stale]:
    """A jump back whose every round begins anew; one from which another way leads to the end is none."""
    if graph.leads(target, None, without=begins) or graph.leads(target, jump, without=begins):
        return
    if target in circles()[jump]:
        yield Stale(jump, min(circles()[jump] & begins))


def _assigns(graph: Graph) -> dict[str, set[int]]:
    """The steps that set each counter."""
    found: dict[str, set[int]] = {}
    for number, assign in graph.each(Assign):
        found.setdefault(assign.counter, set()).add(number)
    return found
