"""Sentences for reach failures."""

from collections.abc import Sequence
from typing import Protocol, assert_never

from handeye.core.units import DEGREE, INCH
from handeye.program.diagnosis.reach import (
    BelowTable,
    FixedDirection,
    FixedOrientation,
    HeldJoint,
    InLine,
    InnerCylinder,
    JointLimit,
    OutOfReach,
    ReachFailure,
    TooFast,
    TooNear,
)


class NamedJoint(Protocol):
    """A joint with a name."""

    @property
    def name(self) -> str:
        """The link it moves, as people call it."""
        ...

    @property
    def kind(self) -> str:
        """`prismatic` if it slides."""
        ...


class NamedArm(Protocol):
    """An arm with a name."""

    @property
    def name(self) -> str:
        """Its name."""
        ...

    @property
    def joints(self) -> Sequence[NamedJoint]:
        """Joints from base to hand."""
        ...


def reach_sentence(arm: NamedArm, reason: ReachFailure) -> str:
    """The reach_sentence of a reach failure: inches and degrees, joints by number and name."""
    match reason:
        case OutOfReach() | TooNear() | JointLimit():
            return _beyond(arm, reason)
        case InnerCylinder():
            return (
                f"the wrist would have to be {reason.radius / INCH:.1f} in from the axis of joint 1; "
                f"it cannot come nearer than {reason.least / INCH:.1f} in"
            )
        case FixedOrientation():
            return (
                f"the hand would have to be turned by {reason.angle / DEGREE:.1f} degrees, "
                f"and no joint of the {arm.name} arm turns it"
            )
        case FixedDirection():
            return _off_its_way(arm, reason)
        case HeldJoint():
            at = _shown(arm, reason.joint, reason.at, 1)
            return f"{named(arm, reason.joint)} is held at {at} and cannot be moved"
        case InLine():
            one, other = (joint + 1 for joint in reason.joints)
            return (
                f"joints {one} and {other} come into line on the way, "
                "where the hand cannot keep its orientation"
            )
        case TooFast():
            rate, limit = (_shown(arm, reason.joint, x, 0) for x in (reason.rate, reason.limit))
            return f"{named(arm, reason.joint)} would have to move at {rate}/s; it can do {limit}/s"
        case BelowTable():
            return f"the hand would be {reason.depth / INCH:.2f} in below the table"
    assert_never(reason)


def named(arm: NamedArm, joint: int) -> str:
    """A joint by number and name."""
    return f"joint {joint + 1} ({arm.joints[joint].name})"


def _shown(arm: NamedArm, joint: int, value: float, digits: int) -> str:
    scale, unit = _unit(arm, joint)
    return f"{value / scale:.{digits}f} {unit}"


def _unit(arm: NamedArm, joint: int) -> tuple[float, str]:
    return (INCH, "in") if arm.joints[joint].kind == "prismatic" else (DEGREE, "degrees")


def _beyond(arm: NamedArm, reason: OutOfReach | TooNear | JointLimit) -> str:
    begins = "ends" if reason.amount > reason.limit else "begins"
    digits = 1 if reason.excess > 0.05 * _unit(arm, reason.joint)[0] else 3
    amount, limit = (
        _shown(arm, reason.joint, reason.amount, digits),
        _shown(arm, reason.joint, reason.limit, 1),
    )
    return f"{named(arm, reason.joint)} would have to be {amount}; it {begins} at {limit}"


def _off_its_way(arm: NamedArm, reason: FixedDirection) -> str:
    off, movers = f"{reason.off / INCH:.2f} in", [named(arm, joint) for joint in reason.joints]
    if len(movers) == 1:
        return f"the hand would have to be {off} off the line on which {movers[0]} moves it"
    return f"the hand would have to be {off} off the plane in which {' and '.join(movers)} move it"
