"""The base class of all operations. Each operation states the values that it reads and writes, the errors that it
raises, and the devices that it needs. Code that uses only these properties works with every kind of operation.
"""

from collections.abc import Mapping
from typing import ClassVar, Literal, NamedTuple, Self

from handeye.core import errors
from handeye.core.record import Record, Vector3
from handeye.program.guards import Bounds, Guards

Kind = Literal["position", "part", "target", "picture", "difference", "counter", "search", "goal", "travel"]
"""Kinds of values that a run stores.

A target is a position or a part. `goal` is the goal of the last Move, and `travel` is the distance of the last Change.
"""
Family = Literal["motion", "hand", "sight", "test", "search", "other"]
Device = Literal["hand", "screwdriver", "camera"]
Fields = Mapping[Kind, tuple[str, ...]]
"""For each kind of value, the fields of an operation that hold the names of values of this kind. If there is only one
value of the kind, this value has no name, and the tuple is empty.
"""


class Use(NamedTuple):
    """A value that an operation reads or writes. If `level` is True, only the horizontal components of the value
    count.
    """

    kind: Kind
    name: str = ""
    level: bool = False


class Branch(NamedTuple):
    """A branch to the step `target` (None for the end of the program). The branch is taken if the last action raised
    `error`, or if `counter` is positive.
    """

    target: int | None
    error: int | None = None
    counter: str | None = None


class Operation(
    Record, frozen=True, kw_only=True, omit_defaults=True, tag_field="op", tag=lambda name: name.lower()
):
    """Base class of the operations. The class name in lower case is the tag in the plan file.

    Each field stands for a property. The default value of a field means that the operation does not have the property.
    The plan file can therefore leave out fields that have their default value.
    """

    family: ClassVar[Family] = "other"
    moves: ClassVar[bool] = False  # moves the arm or the hand
    takes_time: ClassVar[bool] = False
    needs: ClassVar[Device | None] = None  # device that is needed in addition to the arm
    planned: ClassVar[bool] = False  # needs a planned motion
    only_checks: ClassVar[bool] = False  # an action without an effect
    branches: ClassVar[bool] = False  # may continue elsewhere than at the next step
    raising: ClassVar[frozenset[int]] = frozenset()  # errors of the whole class; empty: not an action
    reading: ClassVar[Fields] = {}
    writing: ClassVar[Fields] = {}
    bounds: ClassVar[Mapping[str, Bounds]] = {}  # limits of numbers, and of the sizes of vectors
    choices: ClassVar[Mapping[str, tuple[float, ...]]] = {}  # allowed values, SI

    @property
    def raises(self) -> frozenset[int]:
        """Numbers of the errors that the operation can raise."""
        return self.raising

    @property
    def guards(self) -> Guards:
        """Guards that may end the operation."""
        return ()

    @property
    def press(self) -> Vector3 | None:
        """Force (N, table axes) that the hand exerts during the motion."""
        return None

    @property
    def complies(self) -> bool:
        """True if the hand yields to a force or a moment."""
        return False

    @property
    def feels(self) -> bool:
        """True if the course of the motion depends on the force or moment on the hand."""
        return self.complies or any(guard.exerted((0.0, 0.0, 1.0)) is not None for guard in self.guards)

    @property
    def examines(self) -> str | None:
        """The picture that the operation examines."""
        return None

    @property
    def reads(self) -> tuple[Use, ...]:
        """All values on which the operation depends."""
        return self.used(self.reading)

    @property
    def writes(self) -> tuple[Use, ...]:
        """All values that the operation may change."""
        return self.used(self.writing)

    @property
    def calls(self) -> str | None:
        """The message of the operation to the operator."""
        return None

    @property
    def undoes(self) -> int:
        """How often, at most, the operation reverses and repeats its stage."""
        return 0

    @property
    def branch(self) -> Branch | None:
        """The operation's branch, if it has one."""
        return None

    def leading_to(self, target: int | None) -> Self:
        """Return a copy of the operation with a different branch target."""
        raise NotImplementedError(f"{type(self).__name__} has no branch")

    @property
    def goal_position(self) -> str | None:
        """The named position to which the operation moves the hand."""
        return None

    @property
    def knots(self) -> int | None:
        """Number of knots of the planned motion; None if there is no planned motion."""
        return None

    def used(self, fields: Fields) -> tuple[Use, ...]:
        found: list[Use] = []
        for kind, names in fields.items():
            if not names:
                found.append(Use(kind))
            for field in names:
                value = getattr(self, field)
                found += [Use(kind, name) for name in ((value,) if isinstance(value, str) else value)]
        return tuple(found)


def action(*numbers: int) -> frozenset[int]:
    """Return the errors that an action can raise: the given numbers, and the number of the watchdog's error."""
    return frozenset({errors.WATCHDOG, *numbers})
