"""Reasons why an arm cannot reach a pose or make a motion, as facts and as sentences. In the facts, joint numbers
begin at 0, and quantities are in SI units.
"""

from collections.abc import Sequence
from typing import Protocol, assert_never

from handeye.core.plain_text import distinct_digits, enough_digits
from handeye.core.record import Record
from handeye.core.units import DEGREE, INCH


class ReachFailureRecord(Record, frozen=True, tag_field="reason", tag=True):
    """Base class of the reasons."""

    @property
    def named_joints(self) -> tuple[int, ...]:
        """The joints that the sentence about this reason names."""
        return ()


class BeyondRange(ReachFailureRecord, frozen=True):
    """Base class of failures in which a joint would leave its range. `limit` is the end of the range, and `amount` is
    the position that the joint would have (both in rad or m).
    """

    joint: int
    amount: float
    limit: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)

    @property
    def excess(self) -> float:
        """How far the joint would be beyond its limit (rad or m)."""
        return abs(self.amount - self.limit)


class OutOfReach(BeyondRange, frozen=True):
    """A prismatic joint would be beyond its range on every branch."""


class TooNear(BeyondRange, frozen=True):
    """The boom would be retracted too far, because the hand would be too near to the column."""


class JointLimit(BeyondRange, frozen=True):
    """A revolute joint would be beyond its range."""


class InnerCylinder(ReachFailureRecord, frozen=True):
    """The wrist would be too near to the axis of the column. Because of the shoulder's offset, the distance (m) cannot
    be less than `least`.
    """

    radius: float
    least: float

    @property
    def excess(self) -> float:
        """By how much the wrist would be too near to the axis (m)."""
        return self.least - self.radius


class FixedOrientation(ReachFailureRecord, frozen=True):
    """The hand would have to turn by `angle` (rad), and the arm has no joint for this turn."""

    angle: float


class FixedDirection(ReachFailureRecord, frozen=True):
    """The hand would be `off` (m) from the line or plane in which the prismatic joints move the hand."""

    joints: tuple[int, ...]
    off: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return self.joints


class HeldJoint(ReachFailureRecord, frozen=True):
    """A joint would have to move although it is held at the position `at` (rad or m)."""

    joint: int
    at: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)


class InLine(ReachFailureRecord, frozen=True):
    """During the motion, two joint axes would line up. Where the axes line up, the arm cannot keep the orientation of
    the hand.
    """

    joints: tuple[int, int]


class TooFast(ReachFailureRecord, frozen=True):
    """A joint would exceed its rate limit (rad/s or m/s)."""

    joint: int
    rate: float
    limit: float

    @property
    def named_joints(self) -> tuple[int, ...]:
        return (self.joint,)


class BelowTable(ReachFailureRecord, frozen=True):
    """The hand would be `depth` (m) below the table top."""

    depth: float


ReachFailure = (
    OutOfReach | TooNear | JointLimit | InnerCylinder | FixedOrientation | FixedDirection
    | HeldJoint | InLine | TooFast | BelowTable
)  # fmt: skip


class NamedJoint(Protocol):
    """A joint with a name."""

    @property
    def name(self) -> str:
        """The name of the link that the joint moves."""
        ...

    @property
    def kind(self) -> str:
        """`prismatic` or `revolute`."""
        ...


class NamedArm(Protocol):
    """An arm with a name."""

    @property
    def name(self) -> str:
        """The arm's name."""
        ...

    @property
    def joints(self) -> Sequence[NamedJoint]:
        """Joints, from base to hand."""
        ...


def reach_sentence(arm: NamedArm, reason: ReachFailure) -> str:
    """Write the sentence for a reach failure, in inches and degrees, with joints by number and name."""
    match reason:
        case OutOfReach() | TooNear() | JointLimit():
            return _beyond(arm, reason)
        case InnerCylinder():
            radius, least = distinct_digits([reason.radius / INCH, reason.least / INCH], 1)
            return (
                f"the wrist would have to be {radius} in from the axis of joint 1; the minimum is {least} in"
            )
        case FixedOrientation():
            return (
                f"the hand would have to turn by {enough_digits(reason.angle / DEGREE, 1)} degrees about an axis "
                f"for which the {arm.name} arm has no joint"
            )
        case FixedDirection():
            movers = [named(arm, joint) for joint in reason.joints]
            where = "line on which" if len(movers) == 1 else "plane in which"
            them = f"{' and '.join(movers)} move{'s' if len(movers) == 1 else ''} the hand"
            return (
                f"the hand would have to be {enough_digits(reason.off / INCH, 2)} in off the {where} {them}"
            )
        case HeldJoint():
            scale, unit = _unit(arm, reason.joint)
            return f"{named(arm, reason.joint)} is held at {reason.at / scale:.1f} {unit} and cannot be moved"
        case InLine():
            one, other = (joint + 1 for joint in reason.joints)
            return (
                f"the axes of joints {one} and {other} line up on the way, and there the hand cannot keep its"
                " angles"
            )
        case TooFast():
            scale, unit = _unit(arm, reason.joint)
            rate, limit = distinct_digits([reason.rate / scale, reason.limit / scale], 0)
            return f"{named(arm, reason.joint)} would have to move at {rate} {unit}/s; its limit is {limit} {unit}/s"
        case BelowTable():
            return f"the hand would be {enough_digits(reason.depth / INCH, 2)} in below the table"
    assert_never(reason)


def named(arm: NamedArm, joint: int) -> str:
    """Write the name of a joint, and its number, counted from 1."""
    return f"joint {joint + 1} ({arm.joints[joint].name})"


def _unit(arm: NamedArm, joint: int) -> tuple[float, str]:
    return (INCH, "in") if arm.joints[joint].kind == "prismatic" else (DEGREE, "degrees")


def _beyond(arm: NamedArm, reason: OutOfReach | TooNear | JointLimit) -> str:
    scale, unit = _unit(arm, reason.joint)
    amount, limit = distinct_digits([reason.amount / scale, reason.limit / scale], 1)
    return f"{named(arm, reason.joint)} would have to be at {amount} {unit}; its limit is {limit} {unit}"
