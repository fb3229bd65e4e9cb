"""Guards: conditions that end a motion. Each guard has the error that is raised if the motion ends before the guard's
condition is met.
"""

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import ClassVar, Final, NamedTuple

from handeye.core import errors
from handeye.core.record import Record, Vector3
from handeye.program.senses import TESTED, Sense

Bounds = tuple[float, float]  # least and greatest value of a number, or size of a vector, SI
FORCE: Final[Bounds] = (1e-6, 1e4)  # N, or N m


class GuardKind(StrEnum):
    """Kinds of guards, with their names in the plan file."""

    FORCE = "force"
    AGAINST = "against"
    MOMENT = "moment"
    TORQUE = "torque"
    TOUCH = "touch"


class HandLoad(NamedTuple):
    """A force (N) or a moment (N m) that the hand exerts, in table axes. `turning` is True for a moment."""

    vector: Vector3
    turning: bool


class Guard(Record, frozen=True, kw_only=True, tag_field="guard", tag=lambda name: name.lower()):
    """Base class of the guards. In lower case, the name of a guard's class is the guard's kind, and also the tag of
    the guard in the plan file.
    """

    kind: ClassVar[GuardKind]
    error: ClassVar[int]  # raised if the motion ends before the guard trips
    bounds: ClassVar[Mapping[str, Bounds]]

    @classmethod
    def sense(cls) -> Sense | None:
        """Return the sense on which the guard depends. Return None if the guard depends on the current of the
        screwdriver's motor, which is not a sense.
        """
        return TESTED.get(cls.error)

    def exerted(self, along: Vector3 | None) -> "HandLoad | None":
        """Return the least force or moment that trips the guard in a motion along the vector `along`, or None if no
        force trips the guard.
        """
        return None


class Force(Guard, frozen=True, kw_only=True):
    """Trips when the hand exerts more than `force` (N, table axes). Only the component in the direction of `force`
    counts.
    """

    kind: ClassVar = GuardKind.FORCE
    error: ClassVar = errors.NO_FORCE
    bounds: ClassVar = {"force": FORCE}

    force: Vector3

    def exerted(self, along: Vector3 | None) -> HandLoad:
        return HandLoad(self.force, turning=False)


class Against(Guard, frozen=True, kw_only=True):
    """Trips when more than `force` (N) opposes the motion, in whatever direction the hand moves."""

    kind: ClassVar = GuardKind.AGAINST
    error: ClassVar = errors.NO_FORCE
    bounds: ClassVar = {"force": FORCE}

    force: float

    def exerted(self, along: Vector3 | None) -> HandLoad | None:
        if along is None:
            return None
        x, y, z = along
        scale = self.force / math.hypot(x, y, z)
        return HandLoad((x * scale, y * scale, z * scale), turning=False)


class Moment(Guard, frozen=True, kw_only=True):
    """Trips when the hand exerts more than `moment` (N m, table axes). The moment is taken about the tool centre point
    of the hand.
    """

    kind: ClassVar = GuardKind.MOMENT
    error: ClassVar = errors.NO_FORCE
    bounds: ClassVar = {"moment": FORCE}

    moment: Vector3

    def exerted(self, along: Vector3 | None) -> HandLoad:
        return HandLoad(self.moment, turning=True)


class Torque(Guard, frozen=True, kw_only=True):
    """Trips when the motor of the screwdriver exerts this torque (N m)."""

    kind: ClassVar = GuardKind.TORQUE
    error: ClassVar = errors.NO_TORQUE
    bounds: ClassVar = {"torque": FORCE}

    torque: float


class Touch(Guard, frozen=True, kw_only=True):
    """Trips when a finger touches. Finger 1 is on the +y side of the hand, and finger 2 on the other side; 3 stands
    for either finger.
    """

    kind: ClassVar = GuardKind.TOUCH
    error: ClassVar = errors.NO_TOUCH
    bounds: ClassVar = {"fingers": (1, 3)}

    fingers: int


AnyGuard = Force | Against | Moment | Torque | Touch
Guards = tuple[AnyGuard, ...]


def unmet(guards: Sequence[AnyGuard]) -> int:
    """Return the error of a motion that ends although none of its guards tripped. There must be at least one guard."""
    return guards[0].error
