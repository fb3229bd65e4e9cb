"""RESTOREs of differences that are saved, but on no way that leads to them.

A difference that is saved for the very goal it is restored for follows something that moves: zero is where it starts.
"""

from collections.abc import Iterator
from heapq import heappop, heappush

from handeye.al.graph import Graph
from handeye.al.lower import Lowered
from handeye.al.syntax import Name, Statement
from handeye.diagnostics import Diagnostic, Label, quoted
from handeye.plan.program import Move, Save
from handeye.source import Span


def check_restores(lowered: Lowered) -> Iterator[Diagnostic]:
    """A warning for each that is at fault in every call; a name that no SAVE has is told of with the names."""
    first: dict[str, Name] = {}
    for step, origin in zip(lowered.steps, lowered.origins, strict=True):
        if isinstance(step.operation, Save):
            first.setdefault(step.operation.name, _name(origin))
    bits = {name: 1 << number for number, name in enumerate(first)}
    lost: dict[Span, Name] = {}
    right: set[Span] = set()
    graph = Graph(lowered.steps)
    for number, saved in _saved(graph, bits).items():
        operation = lowered.steps[number].operation
        restores = operation.restore if isinstance(operation, Move) else ()
        for restore, statement in zip(restores, lowered.shifts[number], strict=True):
            if saved & bits.get(restore.name, 0) or _follows(graph, number, restore.name):
                right.add(statement.span)
            elif restore.name in bits:
                lost[statement.span] = _name(statement)
    for span, name in lost.items():
        if span not in right:
            yield _never_saved(name, first[name.text])


def _follows(graph: Graph, move: int, name: str) -> bool:
    """Whether a difference is saved from the goal of a MOVE: on a way from it, before the next."""
    seen: set[int] = set()
    waiting = list(graph.onward[move])
    while waiting:
        number = waiting.pop()
        if number is None or number in seen:
            continue
        seen.add(number)
        operation = graph.steps[number].operation
        if isinstance(operation, Save) and operation.name == name:
            return True
        if not isinstance(operation, Move):
            waiting += graph.onward[number]
    return False


def _saved(graph: Graph, bits: dict[str, int]) -> dict[int, int]:
    """For each step that is come to: the names that may have been saved, as bits."""
    before = {0: 0}
    waiting = [0]
    while waiting:
        number = heappop(waiting)
        operation = graph.steps[number].operation
        after = before[number] | (bits[operation.name] if isinstance(operation, Save) else 0)
        for target in graph.onward[number]:
            if target is not None and (target not in before or after & ~before[target]):
                before[target] = before.get(target, 0) | after
                heappush(waiting, target)
    return before


def _never_saved(name: Name, save: Name) -> Diagnostic:
    message = f"no `SAVE` of {quoted(name.text)} comes before this `RESTORE`: the goal is not shifted"
    here = Label(span=save.span, text="it is saved only here")
    return Diagnostic(code="never-saved", message=message, primary=Label(span=name.span), secondary=(here,))


def _name(statement: Statement) -> Name:
    name = statement.operands[0]
    assert isinstance(name, Name)
    return name
