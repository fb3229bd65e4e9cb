"""The steps of a program, as a directed graph."""

from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from heapq import heappop, heappush
from typing import Final, TypeVar

from handeye.program.operation import Operation
from handeye.program.program import Step

A = TypeVar("A", bound=Operation)
MAX_SEARCHED: Final = 100  # steps


@dataclass(frozen=True, slots=True)
class Graph:
    """Steps by number, with their predecessors and successors; the successor None stands for the end of the program.
    For each kind of operation, the graph has the numbers of the steps with this operation. It also has the reachable
    steps.
    """

    steps: Sequence[Step]
    onward: list[tuple[int | None, ...]] = field(init=False)
    back: list[list[int]] = field(init=False)
    kinds: dict[type[Operation], list[int]] = field(init=False)
    reached: set[int] = field(init=False)

    def __post_init__(self) -> None:
        kinds: dict[type[Operation], list[int]] = {}
        for number, step in enumerate(self.steps):
            kinds.setdefault(type(step.operation), []).append(number)
        object.__setattr__(self, "kinds", kinds)
        onward: list[tuple[int | None, ...]] = [(step.next,) for step in self.steps]
        for kind, numbers in kinds.items():
            if kind.branches:
                for number in numbers:
                    onward[number] = self.steps[number].ways
        back: list[list[int]] = [[] for _ in self.steps]
        for number, targets in enumerate(onward):
            for target in targets:
                if target is not None:
                    back[target].append(number)
        object.__setattr__(self, "onward", onward)
        object.__setattr__(self, "back", back)
        object.__setattr__(self, "reached", reachable([0] if self.steps else [], onward))

    def which(self, *kinds: type[Operation]) -> list[int]:
        """Return the numbers of the steps whose operation is of one of the given kinds, in order."""
        return sorted(number for kind in kinds for number in self.kinds.get(kind, ()))

    def each(self, kind: type[A]) -> Iterator[tuple[int, A]]:
        """Yield the number and the operation of each step whose operation is of the given kind, in order."""
        for number in self.kinds.get(kind, ()):
            operation = self.steps[number].operation
            if isinstance(operation, kind):
                yield number, operation

    def at(self, number: int | None, kind: type[A]) -> A | None:
        """Return the operation of a step, or None if the operation is not of the given kind."""
        operation = None if number is None else self.steps[number].operation
        return operation if isinstance(operation, kind) else None

    def actions(self) -> list[int]:
        """Return the steps that can raise an error or clear one."""
        return self.which(*(kind for kind in self.kinds if kind.raising))

    def after(self, numbers: Iterable[int]) -> set[int]:
        """Return the steps that can follow the given steps, directly or indirectly."""
        return reachable([target for number in numbers for target in self.onward[number]], self.onward)

    def before(self, numbers: Iterable[int]) -> set[int]:
        """Return the steps that can precede the given steps, directly or indirectly."""
        return reachable([before for number in numbers for before in self.back[number]], self.back)

    def last(self, number: int, *kinds: type[Operation]) -> list[int]:
        """On every path to step `number`, find the last step of the given kinds, and return all these steps. Only
        reachable steps count. The list is empty if a path contains no step of these kinds, or if the search takes too
        long.
        """
        found: list[int] = []
        seen: set[int] = set()
        waiting = [number]
        while waiting:
            here = waiting.pop()
            if here == 0 or len(seen) > MAX_SEARCHED:
                return []
            for before in self.back[here]:
                if before in seen or before not in self.reached:
                    continue
                seen.add(before)
                (found if type(self.steps[before].operation) in kinds else waiting).append(before)
        return found

    def leads(self, first: int | None, last: int | None, without: Container[int]) -> bool:
        """Return True if a path leads from step `first` to step `last` without passing any step in `without`. If
        `last` is None, the path must lead to the end of the program. Nearby steps are searched first.
        """
        waiting = [] if first is None or first in without else [first]
        seen = set(waiting)
        while waiting:
            number = heappop(waiting)
            if number == last or (last is None and None in self.onward[number]):
                return True
            for target in self.onward[number]:
                if target is not None and target not in seen and target not in without:
                    seen.add(target)
                    heappush(waiting, target)
        return False

    def circles(self) -> list[set[int]]:
        """Return, for each step, the strongly connected component to which it belongs (Kosaraju's algorithm)."""
        found: list[set[int]] = [set() for _ in self.steps]
        for start in reversed(self._finished()):
            circle, waiting = found[start], [start]
            while waiting:
                number = waiting.pop()
                if not found[number]:
                    circle.add(number)
                    found[number] = circle
                    waiting += self.back[number]
        return found

    def _finished(self) -> list[int]:
        """Return the steps in the order in which a depth-first search finishes them."""
        finished: list[int] = []
        seen: set[int] = set()
        waiting = [(number, False) for number in range(len(self.steps))]
        while waiting:
            number, done = waiting.pop()
            if done:
                finished.append(number)
            elif number not in seen:
                seen.add(number)
                waiting.append((number, True))
                waiting += [(target, False) for target in self.onward[number] if target is not None]
        return finished

    def trapped(self, exits: Iterable[int]) -> set[int]:
        """Return the steps from which neither the end nor any of `exits` can be reached."""
        out = set(exits)
        turns = {n for n, step in enumerate(self.steps) if step.next is not None and step.next <= n} - out
        if all(any(t is None or t > n for t in self.onward[n]) for n in turns):
            return (
                set()
            )  # a trapped set has a last step, from which all edges lead back; there is no such step
        out.update(number for number, targets in enumerate(self.onward) if None in targets)
        return set(range(len(self.steps))) - reachable(out, self.back)

    def loop(self, start: int, known: set[int]) -> set[int]:
        """Return the steps that can be reached from `start`, or an empty set if one of these steps leads into `known`.
        In both cases, adds the reachable steps to the set `known`.
        """
        found = reachable([start], self.onward, known)
        met = any(target in known for number in found for target in self.onward[number])
        known |= found
        return set() if met else found


def reachable(
    first: Iterable[int | None], edges: Sequence[Iterable[int | None]], without: Iterable[int] = ()
) -> set[int]:
    """Return the nodes that can be reached along edges, including the nodes in `first`."""
    found = set(without)
    waiting = list(first)
    while waiting:
        number = waiting.pop()
        if number is not None and number not in found:
            found.add(number)
            waiting.extend(edges[number])
    return found.difference(without)
