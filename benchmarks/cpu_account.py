"""Account of processor time: every second goes to one place and one component of the work, the innermost under way."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from typing import Any, Final

OTHER: Final = "other"
"""The component of whatever is charged to no other."""
_TRIED: Final = 5000
"""Calls by which the account's own cost is measured."""

Function = Callable[..., Any]
Place = tuple[str, ...]
"""What is under way: a phase, or a phase and its stage."""


@dataclass(slots=True, kw_only=True)
class CpuAccount:
    """Adds up what a clock says, by default that of this process, from when it is made."""

    clock: Callable[[], float] = time.process_time
    spent: dict[tuple[Place, str], float] = field(default_factory=dict)
    """CPU s, by place and component."""
    charges: int = 0
    """How often the clock was read."""
    place: Place = ()
    """Where time is charged to now."""
    _components: list[str] = field(default_factory=lambda: [OTHER])
    _since: float = field(init=False)

    def __post_init__(self) -> None:
        self._since = self.clock()

    def at(self, place: Place) -> None:
        """Charge what follows to another place."""
        self._charge()
        self.place = place

    def charged(self, function: Function, component: str) -> Function:
        """A function that does the same, and is charged to a component."""

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
        """While entered, functions are charged: of a module or class, the name of each, and its component."""
        with ExitStack() as put_back:
            for owner, name, component in functions:
                own = getattr(owner, name)
                put_back.callback(setattr, owner, name, own)
                setattr(owner, name, self.charged(own, component))
            yield

    def close(self) -> None:
        """Charge what has passed until now."""
        self._charge()

    def _charge(self) -> None:
        now = self.clock()
        what = self.place, self._components[-1]
        self.spent[what] = self.spent.get(what, 0.0) + now - self._since
        self._since = now
        self.charges += 1

    def own_s(self) -> float:
        """CPU s that the account itself has taken, by what as many charges of nothing cost now."""
        tried = CpuAccount(clock=self.clock)
        nothing = tried.charged(lambda: None, OTHER)
        begun = self.clock()
        for _ in range(_TRIED):
            nothing()
        return (self.clock() - begun) / (2 * _TRIED) * self.charges
