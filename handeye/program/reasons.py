"""Why an arm cannot be, or go, where it is wanted: facts, which `handeye.program.reason_text` puts into words.

Joints are counted from 0; SI units.
"""

from handeye.core.record import Record


class ReasonRecord(Record, frozen=True, tag_field="reason", tag=True):
    """Base of the reasons."""

    @property
    def named_joints(self) -> tuple[int, ...]:
        """Joints that people are told of by name."""
        return ()


class BeyondRange(ReasonRecord, frozen=True):
    """Base of the reasons in which a joint would have to stand beyond its range, rad or m."""

    joint: int
    amount: float
    """Where it would have to be."""
    limit: float
    """The end of its range that this passes."""

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)

    @property
    def excess(self) -> float:
        """The distance beyond that end."""
        return abs(self.amount - self.limit)


class OutOfReach(BeyondRange, frozen=True):
    """A sliding joint would have to stand beyond its range, and no other branch can mend it."""


class TooNear(BeyondRange, frozen=True):
    """A boom would have to be drawn in farther than it can: the hand would be too near to the column."""


class JointLimit(BeyondRange, frozen=True):
    """A turning joint would have to stand beyond its range."""


class InnerCylinder(ReasonRecord, frozen=True):
    """The wrist would come nearer to the axis of the column than the shoulder's offset."""

    radius: float
    """How near, m."""
    least: float
    """How near it can come, m."""

    @property
    def excess(self) -> float:
        """How much too near, m."""
        return self.least - self.radius


class FixedOrientation(ReasonRecord, frozen=True):
    """The hand would have to be turned, and no joint turns it."""

    angle: float
    """By how much, rad."""


class FixedDirection(ReasonRecord, frozen=True):
    """The hand would have to leave the line or plane that the sliding joints span."""

    joints: tuple[int, ...]
    """Those that move it."""
    off: float
    """How far, m."""

    @property
    def named_joints(self) -> tuple[int, ...]:
        return self.joints


class HeldJoint(ReasonRecord, frozen=True):
    """A joint would have to move that is held where it is."""

    joint: int
    at: float
    """rad or m"""

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)


class InLine(ReasonRecord, frozen=True):
    """The axes of two joints come into line on the way, where the hand cannot keep its orientation."""

    joints: tuple[int, int]


class TooFast(ReasonRecord, frozen=True):
    """A joint would have to move faster than it can."""

    joint: int
    rate: float
    """rad/s or m/s"""
    limit: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)


class BelowTable(ReasonRecord, frozen=True):
    """The hand would be below the table top."""

    depth: float
    """m"""


Reason = (
    OutOfReach | TooNear | JointLimit | InnerCylinder | FixedOrientation | FixedDirection
    | HeldJoint | InLine | TooFast | BelowTable
)  # fmt: skip
"""All there are: the first six of poses, the others of motions."""
