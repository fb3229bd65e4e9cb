"""Facts that every operation tells of itself, so that nobody who walks a program has to know the operations by name."""

from collections.abc import Mapping
from typing import ClassVar, Literal, NamedTuple, Self

from handeye.core import errors
from handeye.core.record import Record, Vector3
from handeye.program.guards import Bounds, Guards

Kind = Literal["position", "part", "target", "picture", "difference", "counter", "search", "goal", "travel"]
"""Kinds of what a run keeps: where things are (a target is a position or a part), pictures taken, differences saved,
counters; the search that is set up, the goal of the last Move, and how far the last Change went."""
Family = Literal["motion", "hand", "sight", "test", "search", "other"]
Device = Literal["hand", "screwdriver", "camera"]
Fields = Mapping[Kind, tuple[str, ...]]
"""Fields of an operation that hold names of some kinds; no field: there is only one of that kind, without a name."""


class Use(NamedTuple):
    """Something that an operation reads or writes."""

    kind: Kind
    name: str = ""
    level: bool = False
    """Only its horizontal components count."""


class Branch(NamedTuple):
    """Another way than to the next step, and when it is gone."""

    target: int | None
    """None ends the program."""
    error: int | None = None
    """When the last action raised this error."""
    counter: str | None = None
    """While this counter is still positive."""


class Operation(
    Record, frozen=True, kw_only=True, omit_defaults=True, tag_field="op", tag=lambda name: name.lower()
):
    """Base of the operations; the class name in lower case is the tag on disk.

    A default is always nothing: what is left out of a plan means the same for ever.
    """

    family: ClassVar[Family] = "other"
    moves: ClassVar[bool] = False
    """It leaves the arm, or its hand, in another place."""
    takes_time: ClassVar[bool] = False
    needs: ClassVar[Device | None] = None
    """The device that it is carried out with, if the arm is not enough."""
    planned: ClassVar[bool] = False
    """It cannot be carried out without a planned motion."""
    only_checks: ClassVar[bool] = False
    """An action that changes nothing of what the one before has done."""
    branches: ClassVar[bool] = False
    """It may lead elsewhere than to the next step."""
    raising: ClassVar[frozenset[int]] = frozenset()
    """Errors that any operation of its class can raise; none: it is no action."""
    reading: ClassVar[Fields] = {}
    writing: ClassVar[Fields] = {}
    bounds: ClassVar[Mapping[str, Bounds]] = {}
    """Of its numbers, and of the sizes of its vectors."""
    choices: ClassVar[Mapping[str, tuple[float, ...]]] = {}
    """The only values of some of its numbers, SI."""

    @property
    def raises(self) -> frozenset[int]:
        """The numbers of the errors it can raise."""
        return self.raising

    @property
    def guards(self) -> Guards:
        """The guards that may end it."""
        return ()

    @property
    def press(self) -> Vector3 | None:
        """The force that it exerts while it moves, N, table coordinates."""
        return None

    @property
    def complies(self) -> bool:
        """True if force or moment moves the hand on the way."""
        return False

    @property
    def feels(self) -> bool:
        """True if the force or moment of the hand decides how it goes."""
        return self.complies or any(guard.exerted((0.0, 0.0, 1.0)) is not None for guard in self.guards)

    @property
    def straight_way(self) -> Vector3 | None:
        """The way of the hand, m, table coordinates, if it goes straight from where it is."""
        return None

    @property
    def examines(self) -> str | None:
        """The picture in which it looks for something, if it does."""
        return None

    @property
    def reads(self) -> tuple[Use, ...]:
        """Everything that decides how it is carried out."""
        return self.used(self.reading)

    @property
    def writes(self) -> tuple[Use, ...]:
        """Everything that it may change."""
        return self.used(self.writing)

    @property
    def calls(self) -> str | None:
        """The words with which it calls the operator, if it does."""
        return None

    @property
    def undoes(self) -> int:
        """How often, at most, it has the arm undo its stage and begin it anew; then the program goes on behind it."""
        return 0

    @property
    def branch(self) -> Branch | None:
        """The other way it may lead, if there is one."""
        return None

    def leading_to(self, target: int | None) -> Self:
        """The same with another target of its branch."""
        raise NotImplementedError(f"{type(self).__name__} has no branch")

    @property
    def goal_position(self) -> str | None:
        """The position that it leads the hand to, if it leads it to one."""
        return None

    @property
    def knots(self) -> int | None:
        """Number of knots of its planned motion; None: it moves no joint along a plan."""
        return None

    def used(self, fields: Fields) -> tuple[Use, ...]:
        """Everything that some of its fields name."""
        found: list[Use] = []
        for kind, names in fields.items():
            if not names:
                found.append(Use(kind))
            for field in names:
                value = getattr(self, field)
                found += [Use(kind, name) for name in ((value,) if isinstance(value, str) else value)]
        return tuple(found)


def action(*numbers: int) -> frozenset[int]:
    """The errors of an action: these, and what the watchdog raises in any."""
    return frozenset({errors.WATCHDOG, *numbers})
