"""Finds the faults that a check of a program should detect. If the check fails, it calls the operator or raises an
error. The check should detect a fault if the fault's declaration expects this call or error.
"""

import re
from collections.abc import Sequence
from typing import Final

from handeye.core import errors
from handeye.core.faults import Catalogue, Fault, FaultKind
from handeye.program.flow_operations import Test
from handeye.program.program import Program
from handeye.proof.outcomes import END, SUCCESS, OutcomeGraph
from handeye.trials.mutants.rules import Mutant

NEAR: Final = 40  # nodes that are searched for the call of a failed check, from the check on
CALLS: Final = 3  # calls, at most


def faults_for(
    mutant: Mutant, program: Program, graph: OutcomeGraph, catalogue: Catalogue, most: int
) -> list[Fault]:
    """Return faults that the program should notice by the check that a mutant lacks. `most` is the greatest number of
    faults to return. Faults that can begin at the mutant's stage come first, because their runs are short. All other
    faults come last. In each of the two groups, the faults are sorted by their number of expected errors and calls,
    the smallest number first. Of faults whose names differ only in numbers, only the first is returned.
    """
    calls, stops = calls_of(mutant.steps, program, graph)
    kinds = [
        kind
        for kind in catalogue.kinds.values()
        if any(map(kind.expected.called, calls)) or stops & set(kind.expected.errors)
    ]
    kinds.sort(key=lambda kind: (kind.from_start, len(kind.expected.calls) + len(kind.expected.errors)))
    first = {re.sub(r"\d+", "", kind.name): kind for kind in reversed(kinds)}  # one of each group
    chosen = [kind for kind in kinds if kind in first.values()]
    return [_usual(kind, mutant.stage) for kind in chosen[:most]]


def _usual(kind: FaultKind, stage: int) -> Fault:
    return kind.usual(None if kind.from_start else stage)


def calls_of(steps: Sequence[int], program: Program, graph: OutcomeGraph) -> tuple[list[str], set[int]]:
    """Return what follows if the given steps fail: the first calls to the operator, and the errors with which the
    steps themselves stop the arm.
    """
    changed, calls, stops = set(steps), list[str](), set[int]()
    waiting: list[int] = []
    for node, (number, error) in enumerate(graph.nodes):
        operation = program.steps[number].operation
        if number not in changed:
            continue
        if operation.calls is not None:
            calls.append(operation.calls)
        elif isinstance(operation, Test):
            waiting += [edge.to for edge in graph.edges[node]]
        elif operation.raising and not error:
            raised = {edge.outcome for edge in graph.edges[node]} - {SUCCESS, None}
            stops |= _specific(program, number) - raised
            waiting += [edge.to for edge in graph.edges[node] if edge.outcome in _specific(program, number)]
    return [*dict.fromkeys([*calls, *_nearest(graph, waiting)])][: CALLS * len(steps)], stops


def _specific(program: Program, number: int) -> set[int]:
    """Return the errors that a step is meant to raise. For a step with guards, these are the errors of its guards.
    For a step that only checks or examines, these are all errors of the step except the error of the watchdog. For any
    other step, the set is empty.
    """
    operation = program.steps[number].operation
    if operation.guards:
        return {guard.error for guard in operation.guards}
    checks = operation.only_checks or operation.examines is not None
    return set(operation.raises) - {errors.WATCHDOG} if checks else set()


def _nearest(graph: OutcomeGraph, starts: Sequence[int]) -> list[str]:
    found: list[str] = []
    for start in starts:
        seen, waiting = {start}, [start]
        while waiting and len(seen) < NEAR:
            node = waiting.pop(0)
            if node == END:
                continue
            call = graph.step(node).operation.calls
            if call is not None:
                found.append(call)
                break
            for edge in graph.edges[node]:
                if edge.to not in seen:
                    seen.add(edge.to)
                    waiting.append(edge.to)
    return found
