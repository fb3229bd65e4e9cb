"""The steps of a program as a graph: what leads where, what comes before what."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from handeye.plan.program import Countdown, Operation, Step, Test


@dataclass(frozen=True, slots=True)
class Graph:
    """Steps by number, and the steps each can lead to; None is the end of the program."""

    steps: Sequence[Step]
    onward: list[tuple[int | None, ...]] = field(init=False)
    back: list[list[int]] = field(init=False)
    """Steps that lead to each."""
    kinds: dict[type[Operation], list[int]] = field(init=False)
    """Steps with each kind of operation."""

    def __post_init__(self) -> None:
        onward: list[tuple[int | None, ...]] = []
        back: list[list[int]] = [[] for _ in self.steps]
        kinds: dict[type[Operation], list[int]] = {}
        for number, step in enumerate(self.steps):
            onward.append(_onward(step))
            kinds.setdefault(type(step.operation), []).append(number)
        for number, targets in enumerate(onward):
            for target in targets:
                if target is not None:
                    back[target].append(number)
        object.__setattr__(self, "onward", onward)
        object.__setattr__(self, "back", back)
        object.__setattr__(self, "kinds", kinds)

    def which(self, *kinds: type[Operation]) -> list[int]:
        """The steps whose operation is of one of these kinds, in order."""
        return sorted(number for kind in kinds for number in self.kinds.get(kind, ()))

    def from_start(self) -> set[int]:
        """The steps that can be come to."""
        return _spread([0] if self.steps else [], self.onward)

    def after(self, numbers: Iterable[int]) -> set[int]:
        """The steps that can come, sooner or later, after one of these."""
        return _spread([target for number in numbers for target in self.onward[number]], self.onward)

    def before(self, numbers: Iterable[int]) -> set[int]:
        """The steps after which, sooner or later, one of these can come."""
        return _spread([before for number in numbers for before in self.back[number]], self.back)

    def between(self, first: int | None, last: int, without: Iterable[int] = ()) -> set[int]:
        """The steps on the ways from one to another, both included, that avoid some; none if there is no way."""
        barred = set(without)
        found = _spread([first], self.onward, barred)
        return found & _spread([last], self.back, barred) if last in found else set()

    def trapped(self, exits: Iterable[int]) -> set[int]:
        """The steps from which the program neither ends nor comes to an exit."""
        ends = [number for number, targets in enumerate(self.onward) if None in targets]
        return set(range(len(self.steps))) - _spread([*ends, *exits], self.back)

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
    found = set(without)
    waiting = list(first)
    while waiting:
        number = waiting.pop()
        if number is not None and number not in found:
            found.add(number)
            waiting.extend(edges[number])
    return found.difference(without)
