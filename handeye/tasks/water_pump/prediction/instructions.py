"""What a program says of its motions to positions, in the order of its text."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from handeye.program.flow_operations import Search
from handeye.program.guards import Force
from handeye.program.motion_operations import Change, Height, Move, Open, Restore, Travel
from handeye.program.program import Program


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """A motion to a position, with what the program has set before and what it checks behind it."""

    goal: str
    restore: tuple[Restore, ...]
    gap: float
    """Opening of the fingers that was last asked for, m."""
    search: Search | None
    """The search that it is a place of."""
    pressed: float = 0.0
    """Force down with which the last motion behind it ends, up to the first check, N."""
    pressed_last: float = 0.0
    """The same of the last motion, N."""
    checks: tuple[Travel | Height, ...] = ()
    """Up to the next motion to a position."""

    def pressing(self, operation: Change) -> "Way":
        """The same with a straight motion behind it."""
        forces = [-guard.force[2] for guard in operation.guards if isinstance(guard, Force)]
        if not forces:
            return self
        return replace(self, pressed=self.pressed if self.checks else forces[0], pressed_last=forces[0])

    def checked(self, operation: Travel | Height) -> "Way":
        """The same with a check behind it."""
        return replace(self, checks=(*self.checks, operation))


def ways(program: Program) -> dict[str, list[Way]]:
    """Motions to positions by their goals; those that restore the same are one, with its search if any has one."""
    found: dict[str, list[Way]] = {}
    for way in _ways(program):
        here = found.setdefault(way.goal, [])
        same = next((k for k, other in enumerate(here) if other.restore == way.restore), None)
        if same is None:
            here.append(way)
        elif here[same].search is None and way.search is not None:
            here[same] = way
    return found


def _ways(program: Program) -> Iterator[Way]:
    gap, search = 0.0, None
    way: Way | None = None
    for operation in (step.operation for step in program.steps):
        match operation:
            case Open():
                gap = operation.gap
            case Search():
                search = operation
            case Move():
                if way is not None:
                    yield way
                of = search if operation.searching else None
                way = Way(goal=operation.goal, restore=operation.restore, gap=gap, search=of)
            case Change() if way is not None:
                way = way.pressing(operation)
            case Travel() | Height() if way is not None:
                way = way.checked(operation)
    if way is not None:
        yield way
