"""Counts processor time. Each moment counts for one phase or stage of a run, and for one component: the one called
last.
"""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from typing import Any, Final

OTHER: Final = "other"
"""The component for all time that counts for no other component."""
_TRIED: Final = 5000
"""Number of calls with which the account's own cost is measured."""

Function = Callable[..., Any]
Place = tuple[str, ...]
"""What is in progress: a phase, or a phase and its stage."""


@dataclass(slots=True, kw_only=True)
class CpuAccount:
    """Adds up the time of a clock by place and component, from its creation on. The default clock is this process's CPU
    time.
    """

    clock: Callable[[], float] = time.process_time
    spent: dict[tuple[Place, str], float] = field(default_factory=dict)
    """CPU s, by place and component."""
    charges: int = 0
    """Number of times that the clock was read."""
    place: Place = ()
    """The place for which time counts at present."""
    _components: list[str] = field(default_factory=lambda: [OTHER])
    _since: float = field(init=False)

    def __post_init__(self) -> None:
        self._since = self.clock()

    def at(self, place: Place) -> None:
        """From now on, count time for another place."""
        self._charge()
        self.place = place

    def charged(self, function: Function, component: str) -> Function:
        """Return a function that does the same, and whose time counts for a component."""

        def through(*arguments: Any, **named: Any) -> Any:
            self._charge()
            self._components.append(component)
            try:
                return function(*arguments, **named)
            finally:
                self._charge()
                self._components.pop()

        return through

    @contextmanager
    def charging(self, functions: Sequence[tuple[Any, str, str]]) -> Iterator[None]:
        """Within this context, the time of functions counts for components. Each function is given by its module or
        class, its name, and its component.
        """
        with ExitStack() as put_back:
            for owner, name, component in functions:
                own = getattr(owner, name)
                put_back.callback(setattr, owner, name, own)
                setattr(owner, name, self.charged(own, component))
            yield

    def close(self) -> None:
        """Count the time until now."""
        self._charge()

    def _charge(self) -> None:
        now = self.clock()
        what = self.place, self._components[-1]
        self.spent[what] = self.spent.get(what, 0.0) + now - self._since
        self._since = now
        self.charges += 1

    def own_s(self) -> float:
        """Return the time (CPU s) that the account itself has taken, estimated from calls of an empty function."""
        tried = CpuAccount(clock=self.clock)
        nothing = tried.charged(lambda: None, OTHER)
        begun = self.clock()
        for _ in range(_TRIED):
            nothing()
        return (self.clock() - begun) / (2 * _TRIED) * self.charges
