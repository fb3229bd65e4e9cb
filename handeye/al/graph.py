"""The steps of a program as a graph: what leads where, what comes before what."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

from handeye.plan.program import Countdown, Operation, Step, Test

Condition = Callable[[Operation], bool]


@dataclass(frozen=True, slots=True)
class Graph:
    """Steps by number, and the steps each can lead to; None is the end of the program."""

    steps: Sequence[Step]
    onward: list[tuple[int | None, ...]] = field(init=False)
    back: list[list[int]] = field(init=False)
    """Steps that lead to each."""

    def __post_init__(self) -> None:
        onward = [_onward(step) for step in self.steps]
        back: list[list[int]] = [[] for _ in self.steps]
        for number, targets in enumerate(onward):
            for target in targets:
                if target is not None:
                    back[target].append(number)
        object.__setattr__(self, "onward", onward)
        object.__setattr__(self, "back", back)

    def which(self, condition: Condition) -> list[int]:
        """The steps whose operation meets a condition."""
        return [number for number, step in enumerate(self.steps) if condition(step.operation)]

    def from_start(self) -> set[int]:
        """The steps that can be come to."""
        return _spread([0] if self.steps else [], self.onward)

    def after(self, condition: Condition) -> set[int]:
        """The steps that can come, sooner or later, after one that meets a condition."""
        first = [target for number in self.which(condition) for target in self.onward[number]]
        return _spread(first, self.onward)

    def before(self, condition: Condition) -> set[int]:
        """The steps after which, sooner or later, one that meets a condition can come."""
        first = [number for step in self.which(condition) for number in self.back[step]]
        return _spread(first, self.back)

    def trapped(self, exits: Condition) -> set[int]:
        """The steps from which the program neither ends nor comes to an exit."""
        ends = [number for number, targets in enumerate(self.onward) if None in targets]
        return set(range(len(self.steps))) - _spread([*ends, *self.which(exits)], self.back)

    def loop(self, start: int, known: set[int]) -> set[int]:
        """The steps that can be come to from `start`; none if any of those already known is among them.

        All of them are known from now on.
        """
        found = _spread([start], self.onward, known)
        met = any(target in known for number in found for target in self.onward[number])
        known |= found
        return set() if met else found


def _onward(step: Step) -> tuple[int | None, ...]:
    if isinstance(step.operation, Test):
        return step.next, step.operation.raised
    if isinstance(step.operation, Countdown):
        return step.next, step.operation.positive
    return (step.next,)


def _spread(
    first: Iterable[int | None], edges: Sequence[Iterable[int | None]], without: Iterable[int] = ()
) -> set[int]:
    """Everything that can be come to along edges, the beginning included."""
    found: set[int] = set()
    barred = set(without)
    waiting = list(first)
    while waiting:
        number = waiting.pop()
        if number is not None and number not in found and number not in barred:
            found.add(number)
            waiting.extend(edges[number])
    return found
