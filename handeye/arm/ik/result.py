"""Results of inverse kinematics. Of the solutions within the joint limits, this module chooses the one that the arm
reaches soonest.
"""

import math
from dataclasses import dataclass
from typing import Final

import msgspec
import numpy as np

from handeye.arm.model import ArmModel, Joint
from handeye.core.pose import Array
from handeye.core.units import DEGREE, INCH
from handeye.program.diagnosis.causes import ArmNames, BeyondArm
from handeye.program.diagnosis.reach import JointLimit, OutOfReach, ReachFailure, reach_sentence


@dataclass(frozen=True, slots=True, kw_only=True)
class IKResult:
    """Joint positions for a hand pose, or the reason why the pose or the motion is impossible."""

    q: Array | None = None  # shape (n,), in rad and m
    reason: ReachFailure | None = None  # why there is no solution
    along: float | None = None  # of motions: m along the hand's path

    def message(self, arm: ArmModel) -> str:
        """Write a sentence that says why there is no solution. Returns "" if there is a solution."""
        return "" if self.reason is None else reach_sentence(arm, self.reason)

    def cause(self, arm: ArmModel, goal: str = "") -> BeyondArm:
        """Return the failure as the cause of an error. `goal` is the name of the goal position, or "" if the goal has
        no name.
        """
        # solvers compute with the numbers of arrays, which do not go to disk
        plain = msgspec.to_builtins(self.reason, enc_hook=np.generic.item)
        return BeyondArm(goal=goal, reason=msgspec.convert(plain, ReachFailure), arm=ArmNames.of(arm))


SLACK: Final = 1e-9  # round-off allowed beyond a joint limit, in rad or m
WRITTEN: Final = (0.0025 * INCH, 0.0125 * DEGREE)
"""Greatest distance (m) and turn (rad) by which a pose may be off because the pose is written with few digits. An
error is the root of the sum of the squares of distance and turn, each divided by its greatest value. The error may be
at most 1. It is at most .96 if each coordinate is off by .0005 inch or .005 degrees. The wrist is 10 in behind the
finger tips, so the greatest turn moves the wrist by less than the greatest distance.
"""


def choose(arm: ArmModel, found: list[list[float]], near: list[float]) -> IKResult:
    """Of the solutions within the limits, choose the one that the arm reaches soonest from `near`. If all solutions
    are beyond the limits, the result describes the solution that is least far beyond them, and names its worst joint.
    """
    good = [q for q in found if all(map(_inside, arm.joints, q))]
    if good:

        def travel_time(q: list[float]) -> float:
            return sum(abs(x - y) / joint.speed for joint, x, y in zip(arm.joints, q, near, strict=True))

        return IKResult(q=np.array(min(good, key=travel_time)))
    return min((_fault(arm, q) for q in found), key=lambda fault: fault[0])[1]


def shared(first: Joint, last: Joint, sense: float, one: float, other: float) -> list[tuple[float, float]]:
    """Return all pairs of positions of two joints that turn the hand by the same angle as the pair `one`, `other`.
    Each position is within the limits of its joint. The axes of the two joints are in line.

    If `sense` is positive, both joints turn the hand in the same direction; otherwise, in opposite directions. There
    is one pair for each possible number of whole turns. The first joint stays at the position `one` if the last joint
    can reach the angle that completes the turn of the hand.
    """
    sign, ends, found = math.copysign(1.0, sense), (last.lower, last.upper), []
    turns = math.ceil((first.upper - first.lower + last.upper - last.lower) / (2 * math.pi))
    for turn in range(-turns, turns + 1):
        both = one + sign * other + 2 * math.pi * turn
        low = max(first.lower, min(both - sign * end for end in ends))
        high = min(first.upper, max(both - sign * end for end in ends))
        if low <= high:
            x = min(max(one, low), high)
            found.append((x, sign * (both - x)))
    return found


def _inside(joint: Joint, x: float) -> bool:
    return joint.lower - SLACK <= x <= joint.upper + SLACK


def _fault(arm: ArmModel, q: list[float]) -> tuple[float, IKResult]:
    """Find the joint that is farthest beyond its limit. Returns the time in which this joint would travel back to its
    limit, and a result that names the joint. A prismatic joint beyond its limit takes precedence, because this joint
    is beyond its limit in every branch.
    """
    outside = [(i, j, x) for i, (j, x) in enumerate(zip(arm.joints, q, strict=True)) if not _inside(j, x)]
    excess = [(j.kind == "prismatic", max(x - j.upper, j.lower - x) / j.speed) for _, j, x in outside]
    worst = max(range(len(outside)), key=excess.__getitem__)
    i, joint, x = outside[worst]
    return excess[worst][1], IKResult(reason=beyond(joint, i, x))


def beyond(joint: Joint, index: int, x: float) -> OutOfReach | JointLimit:
    """Return the reason why the position `x` of a joint is impossible: the joint and the limit that it exceeds."""
    limit = joint.upper if x > joint.upper else joint.lower
    return OutOfReach(index, x, limit) if joint.kind == "prismatic" else JointLimit(index, x, limit)


def nearest_turn(joint: Joint, x: float, near: float) -> float:
    """Add whole turns to `x`, and return the value within the limits that is nearest to `near`. If no value is within
    the limits, return the value nearest to the limits.
    """
    if joint.kind == "prismatic":
        return x
    turn = 2 * math.pi
    x += turn * round((near - x) / turn)
    if x > joint.upper and x - turn >= joint.lower - SLACK:
        return x - turn
    if x < joint.lower and x + turn <= joint.upper + SLACK:
        return x + turn
    if x > joint.upper or x < joint.lower:
        middle = (joint.lower + joint.upper) / 2
        x += turn * round((middle - x) / turn)
    return x
