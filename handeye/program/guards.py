"""Guards: each says what ends a motion, and which error it is if the motion ends without."""

import math
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import ClassVar, Final, NamedTuple

from handeye.core import errors
from handeye.core.record import Record, Vector3
from handeye.program.senses import TESTED, Sense

Bounds = tuple[float, float]
"""Least and greatest value of a number, or size of a vector, SI."""
FORCE: Final[Bounds] = (1e-6, 1e4)
"""N, or N m."""


class GuardKind(StrEnum):
    """The kinds of guards, as they are called on disk."""

    FORCE = "force"
    AGAINST = "against"
    MOMENT = "moment"
    TORQUE = "torque"
    TOUCH = "touch"


class Exerted(NamedTuple):
    """A force or moment of the hand, table coordinates."""

    vector: Vector3
    """N, or N m if `turning`."""
    turning: bool


class Guard(Record, frozen=True, kw_only=True, tag_field="guard", tag=lambda name: name.lower()):
    """Base of the guards; the class name in lower case is the kind, and the tag on disk."""

    kind: ClassVar[GuardKind]
    error: ClassVar[int]
    """Raised when the motion ends without meeting it."""
    bounds: ClassVar[Mapping[str, Bounds]]

    @classmethod
    def sense(cls) -> Sense | None:
        """The sense that it goes by; None: the current of the screwdriver's motor."""
        return TESTED.get(cls.error)

    def exerted(self, along: Vector3 | None) -> "Exerted | None":
        """Least force or moment of the hand that meets it in a motion along a vector; None: neither does."""
        return None


class Force(Guard, frozen=True, kw_only=True):
    """The hand presses along a vector with more than its length."""

    kind: ClassVar = GuardKind.FORCE
    error: ClassVar = errors.NO_FORCE
    bounds: ClassVar = {"force": FORCE}

    force: Vector3
    """Force *the hand exerts*, N, table coordinates."""

    def exerted(self, along: Vector3 | None) -> Exerted:
        """The force, whatever the motion is."""
        return Exerted(self.force, turning=False)


class Against(Guard, frozen=True, kw_only=True):
    """The motion is opposed, in whatever direction it goes."""

    kind: ClassVar = GuardKind.AGAINST
    error: ClassVar = errors.NO_FORCE
    bounds: ClassVar = {"force": FORCE}

    force: float
    """N that it takes more than."""

    def exerted(self, along: Vector3 | None) -> Exerted | None:
        """The force along the motion."""
        if along is None:
            return None
        x, y, z = along
        scale = self.force / math.hypot(x, y, z)
        return Exerted((x * scale, y * scale, z * scale), turning=False)


class Moment(Guard, frozen=True, kw_only=True):
    """The hand turns something about a vector with more than its length."""

    kind: ClassVar = GuardKind.MOMENT
    error: ClassVar = errors.NO_FORCE
    bounds: ClassVar = {"moment": FORCE}

    moment: Vector3
    """Moment *the hand exerts* about its tool centre point, N m, table coordinates."""

    def exerted(self, along: Vector3 | None) -> Exerted:
        """The moment, whatever the motion is."""
        return Exerted(self.moment, turning=True)


class Torque(Guard, frozen=True, kw_only=True):
    """The screwdriver's motor exerts a torque."""

    kind: ClassVar = GuardKind.TORQUE
    error: ClassVar = errors.NO_TORQUE
    bounds: ClassVar = {"torque": FORCE}

    torque: float
    """N m"""


class Touch(Guard, frozen=True, kw_only=True):
    """A finger touches something."""

    kind: ClassVar = GuardKind.TOUCH
    error: ClassVar = errors.NO_TOUCH
    bounds: ClassVar = {"fingers": (1, 3)}

    fingers: int
    """1: the finger on the +y side of the hand frame, 2: the other, 3: either."""


AnyGuard = Force | Against | Moment | Torque | Touch
Guards = tuple[AnyGuard, ...]
"""Whichever is met first ends the motion; none: nothing does before its end."""


def unmet(guards: Sequence[AnyGuard]) -> int:
    """The error of a motion that ends without meeting what was to stop it; there is at least one guard."""
    return guards[0].error
