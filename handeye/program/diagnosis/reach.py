"""Reach failures: why an arm cannot take up a pose or make a motion. Joints count from 0; SI units."""

from handeye.core.record import Record


class ReachFailureRecord(Record, frozen=True, tag_field="reason", tag=True):
    """Base of the reach failures."""

    @property
    def named_joints(self) -> tuple[int, ...]:
        """Joints named in its sentence."""
        return ()


class BeyondRange(ReachFailureRecord, frozen=True):
    """Base of failures with a joint at `amount`, beyond the end `limit` of its range (rad, m)."""

    joint: int
    amount: float
    limit: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)

    @property
    def excess(self) -> float:
        """Distance beyond the limit."""
        return abs(self.amount - self.limit)


class OutOfReach(BeyondRange, frozen=True):
    """A sliding joint beyond its range, on every branch."""


class TooNear(BeyondRange, frozen=True):
    """A boom retracted too far: the hand is too near to the column."""


class JointLimit(BeyondRange, frozen=True):
    """A turning joint beyond its range."""


class InnerCylinder(ReachFailureRecord, frozen=True):
    """The wrist nearer to the column's axis (m) than the shoulder's offset allows."""

    radius: float
    least: float

    @property
    def excess(self) -> float:
        """Distance too near, m."""
        return self.least - self.radius


class FixedOrientation(ReachFailureRecord, frozen=True):
    """The hand turned by `angle` (rad), which no joint can do."""

    angle: float


class FixedDirection(ReachFailureRecord, frozen=True):
    """The hand `off` (m) the line or plane spanned by the sliding joints."""

    joints: tuple[int, ...]
    off: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return self.joints


class HeldJoint(ReachFailureRecord, frozen=True):
    """A joint that would have to move, held at `at` (rad, m)."""

    joint: int
    at: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)


class InLine(ReachFailureRecord, frozen=True):
    """Two joint axes that come into line on the way, where the orientation cannot be kept."""

    joints: tuple[int, int]


class TooFast(ReachFailureRecord, frozen=True):
    """A joint that would exceed its rate limit (rad/s, m/s)."""

    joint: int
    rate: float
    limit: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)


class BelowTable(ReachFailureRecord, frozen=True):
    """The hand `depth` (m) below the table top."""

    depth: float


ReachFailure = (
    OutOfReach | TooNear | JointLimit | InnerCylinder | FixedOrientation | FixedDirection
    | HeldJoint | InLine | TooFast | BelowTable
)  # fmt: skip
"""The first six are failures of poses, the others of motions."""
