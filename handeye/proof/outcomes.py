"""The paths through a program, as a graph in which every action has one edge for each outcome.

An action either succeeds or raises one of its errors. When an action raises an error, the path continues at the tests
that follow the action, as the executor does. If one of these tests is for the raised error, the path continues at the
target of this test. Otherwise, the arm stops. A call to the operator is a stop, too.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final, NamedTuple

from handeye.core import errors
from handeye.program.flow_operations import Assign, Countdown, Test, Undo
from handeye.program.operation import Operation
from handeye.program.program import Step

END: Final = -1  # the node after the last step
SUCCESS: Final = 0  # the outcome of an action that raises no error
ALWAYS: Final = frozenset({errors.WATCHDOG, errors.GAP_WRONG})
"""Errors that any action may raise, because the servo or the hand can raise them during the action."""


class Edge(NamedTuple):
    """An edge to another node.

    `outcome` is the outcome of the action at the start of the edge: SUCCESS, or the number of the raised error.
    `outcome` is None if the step is not an action. `taken` is True if the step is a test and its error was raised, or
    if the step counts down and the counter was still positive.
    """

    to: int
    outcome: int | None = None
    taken: bool = False


@dataclass(frozen=True, slots=True)
class OutcomeGraph:
    """The reachable nodes of a program. Each node is a step together with the error that is pending before the step,
    or 0 if no error is pending. Node 0 is the first step.
    """

    steps: Sequence[Step]
    nodes: list[tuple[int, int]] = field(init=False)
    edges: list[list[Edge]] = field(init=False)
    back: list[list[int]] = field(init=False)
    ends: list[int] = field(init=False)  # nodes with an edge to the end
    kinds: dict[type[Operation], list[int]] = field(init=False)  # nodes by the kinds of their operations

    def __post_init__(self) -> None:
        numbers: dict[tuple[int, int], int] = {}
        nodes: list[tuple[int, int]] = []

        def node(step: int | None, error: int) -> int:
            if step is None:
                return END
            if (step, error) not in numbers:
                numbers[step, error] = len(nodes)
                nodes.append((step, error))
            return numbers[step, error]

        if self.steps:
            node(0, SUCCESS)
        edges: list[list[Edge]] = []
        for step, error in nodes:  # the list grows meanwhile
            edges.append(
                [
                    Edge(node(target, pending), outcome, taken)
                    for target, pending, outcome, taken in _onward(self.steps, step, error)
                ]
            )
        back: list[list[int]] = [[] for _ in nodes]
        for number, leaving in enumerate(edges):
            for target in {edge.to for edge in leaving} - {END}:
                back[target].append(number)
        object.__setattr__(self, "nodes", nodes)
        object.__setattr__(self, "edges", edges)
        object.__setattr__(self, "back", back)
        ends = [number for number, leaving in enumerate(edges) if any(edge.to == END for edge in leaving)]
        object.__setattr__(self, "ends", ends)
        kinds: dict[type[Operation], list[int]] = {}
        for number, (step, _) in enumerate(nodes):
            kinds.setdefault(type(self.steps[step].operation), []).append(number)
        object.__setattr__(self, "kinds", kinds)

    def step(self, node: int) -> Step:
        return self.steps[self.nodes[node][0]]

    def live_counters(self) -> list[frozenset[str]]:
        """Return, for each node, the counters whose values may still decide where the path leads."""
        live: list[frozenset[str]] = [frozenset()] * len(self.nodes)
        waiting = list(range(len(self.nodes)))
        while waiting:
            number = waiting.pop()
            operation = self.step(number).operation
            after = frozenset().union(*(live[edge.to] for edge in self.edges[number] if edge.to != END))
            if isinstance(operation, Assign):
                after -= {operation.counter}
            elif isinstance(operation, Countdown):
                after |= {operation.counter}
            if after != live[number]:
                live[number] = after
                waiting += self.back[number]
        return live


Onward = tuple[int | None, int, int | None, bool]  # step, pending error, outcome, taken


def _onward(steps: Sequence[Step], number: int, error: int) -> list[Onward]:
    step = steps[number]
    operation = step.operation
    if isinstance(operation, Test):
        if operation.number == error:
            return [(operation.raised, SUCCESS, None, True)]
        return [(step.next, error, None, False)] if _goes_on(steps, step.next, error) else []
    if operation.calls is not None:
        return []
    if isinstance(operation, Countdown):
        return [(step.next, SUCCESS, None, False), (operation.positive, SUCCESS, None, True)]
    if isinstance(operation, Undo):
        begun = _entries(steps, step.stage)
        return [(step.next, SUCCESS, None, False), *((entry, SUCCESS, None, True) for entry in begun)]
    if not operation.raising:
        return [(step.next, SUCCESS, None, False)]
    raised = sorted(each for each in operation.raises | ALWAYS if _goes_on(steps, step.next, each))
    return [(step.next, each, each, False) for each in (SUCCESS, *raised)]


def _goes_on(steps: Sequence[Step], number: int | None, error: int) -> bool:
    """Return True if the program continues at step `number` while `error` is pending, or False if the arm stops."""
    while error and number is not None:
        operation = steps[number].operation
        if not isinstance(operation, Test):
            return False
        if operation.number == error:
            return True
        number = steps[number].next
    return not error


def _entries(steps: Sequence[Step], stage: int) -> list[int]:
    """Return the steps at which a stage can begin."""
    inside = {number for number, step in enumerate(steps) if step.stage == stage}
    entered = {way for number, step in enumerate(steps) if number not in inside for way in step.ways}
    return sorted(inside & ({0} | {way for way in entered if way is not None}))
