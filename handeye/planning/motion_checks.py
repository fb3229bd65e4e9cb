"""Checks that each planned motion is free of collisions, and that the arm is strong enough for the motion."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.arm.dynamics import gravity
from handeye.arm.friction import faint
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.model import ArmModel, constants
from handeye.core.codes import CODES
from handeye.core.obb import Box, depths, lowest
from handeye.core.pose import Array, Pose, inverse, planar
from handeye.core.record import Vector3
from handeye.core.units import INCH
from handeye.planning.grasp_state import GraspState
from handeye.program.diagnosis.plan_findings import PlanFinding, RunsInto, TooFaint, TooHeavy, TooWeak
from handeye.program.flow_operations import Load
from handeye.program.guards import Guards, HandLoad
from handeye.program.motion_operations import Change
from handeye.program.program import Program, Step


@dataclass(slots=True)
class FindingList:
    """Findings in text order, at most one for each code and position."""

    findings: list[PlanFinding] = field(default_factory=list)
    _reported: set[tuple[str, str]] = field(default_factory=set)

    def add(self, finding: PlanFinding) -> None:
        """Add a finding, unless the list has one with the same code and position."""
        if finding.position is not None:
            if (finding.code, finding.position) in self._reported:
                return
            self._reported.add((finding.code, finding.position))
        self.findings.append(finding)

    @property
    def is_fatal(self) -> bool:
        """True if a finding is an error, so that the program gets no plan."""
        return any(CODES[finding.code].severity == "error" for finding in self.findings)


OVERLAP: Final = 0.1 * INCH
"""Tolerated overlap of boxes (m).

Free motions of the pump's program deviate from a straight descent by up to this distance. Boxes may therefore overlap:
in the plan, for example, the returning screwdriver overlaps its rack by .02 in.
"""

SAME: Final = 1e-6  # m; depths that differ by less count as equal, so that every processor finds the same one


@dataclass(frozen=True, slots=True, kw_only=True)
class Crossing:
    """The deepest collision during a motion."""

    what: str | None  # fixture; None: the table
    depth: float  # m
    along: float  # m travelled up to the deepest point
    at_end: bool  # True if the deepest point is the end


class Obstacles:
    """The fixtures of a program, split into their boxes."""

    def __init__(self, program: Program) -> None:
        fixtures = [
            (name, fixture, box) for name, fixture in program.fixtures.items() for box in fixture.boxes
        ]
        self._names = [name for name, _, _ in fixtures]
        self._boxes = [box for _, _, box in fixtures]
        frames = [inverse(planar(*fixture.at)) for _, fixture, _ in fixtures]
        self._X_FW = np.array(frames).reshape(-1, 4, 4)

    def crossing(self, X_WT: Pose, boxes: Sequence[Box], *, goal: bool) -> Crossing | None:
        """Find the deepest collision of boxes (given in frame T) with a fixture, for hand poses of shape (N, 4,
        4). Returns None if there is no collision.
        """
        if not self._boxes or not boxes:
            return None
        deep = depths(self._X_FW @ X_WT[:, None], boxes, self._boxes)
        return _deepest(X_WT, deep.reshape(len(X_WT), -1), self._names * len(boxes), goal)


def table_crossing(X_WT: Pose, boxes: Sequence[Box], *, goal: bool) -> Crossing | None:
    """Find the deepest collision of the hand's boxes with the table. The boxes are given in frame T, and the hand
    poses have shape (N, 4, 4). Returns None if there is no collision.
    """
    if not boxes:
        return None
    deep = np.maximum(-lowest(X_WT, boxes), 0.0)
    return _deepest(X_WT, deep, [None] * len(boxes), goal)


def _deepest(X_WT: Pose, deep: Array, names: Sequence[str | None], goal: bool) -> Crossing | None:
    """Find the deepest collision from the depths `deep`, shape (N, k). Collisions that exist when the motion begins do
    not count.
    """
    outside = np.logical_or.accumulate(deep <= OVERLAP / 2, axis=0)
    outside[-1] |= goal
    entered = np.where(outside & (deep > OVERLAP), deep, 0.0)
    sample, which = divmod(int(np.argmax(entered >= entered.max() - SAME)), entered.shape[1])
    if entered[sample, which] == 0.0:
        return None
    way = np.linalg.norm(np.diff(X_WT[: sample + 1, :3, 3], axis=0), axis=1)
    return Crossing(
        what=names[which], depth=float(entered[sample, which]), along=float(way.sum()),
        at_end=bool(deep[-1, which] >= entered[sample, which] - OVERLAP),
    )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Weakness:
    """The joint (counted from 0) that limits a force or moment of the hand to `most` (N or N m)."""

    joint: int
    most: float


def weakness(
    arm: ArmModel, q: Array, wanted: Array, *, turning: bool = False, weight: float = 0.0
) -> Weakness | None:
    """Find the joint that prevents the hand from exerting the force `wanted` (N, in W) at one or more of the
    configurations `q`, shape (N, n). Returns None if the hand can exert the force at all configurations. If `turning`
    is True, `wanted` is a moment, in N m. `weight` (N) is the weight of a load in the hand.
    """
    size = float(np.linalg.norm(wanted))
    if size == 0.0:
        return None
    J = np.swapaxes(jacobian(arm, q), -1, -2)
    torque = J[..., 3:] @ wanted if turning else J[..., :3] @ wanted
    left = constants(arm).effort - np.sign(torque) * (gravity(arm, q) + J[..., 2] * weight)
    share = np.maximum(left, 0.0) / np.maximum(np.abs(torque), 1e-12)
    joint = int(np.argmin(share.min(axis=0)))
    least = float(share.min())
    return None if least >= 1.0 else Weakness(joint=joint, most=size * least)


LOAD_STRIDE: Final = 8  # every eighth configuration of a motion is checked for load


@dataclass(frozen=True, slots=True)
class Demand:
    """A force or moment that a motion must be able to exert. `guard` is True if a guard waits for this force or
    moment.
    """

    exerted: HandLoad
    guard: bool


def to_stop(guards: Guards, along: Vector3 | None = None) -> list[Demand]:
    """Return the least forces and moments that trip the guards of a motion. `along` is the direction of the motion, if
    the motion is straight.
    """
    waited = (guard.exerted(along) for guard in guards)
    return [Demand(exerted, guard=True) for exerted in waited if exerted is not None]


def to_press(operation: Change) -> list[Demand]:
    """Return the forces and moments that a straight motion exerts when it presses or turns."""
    both = ((operation.press, False), (operation.moment, True))
    exerted = (HandLoad(wanted, turning) for wanted, turning in both if wanted is not None)
    return [Demand(one, guard=False) for one in exerted]


@dataclass(slots=True)
class Checks:
    """Checks the motions of a program, step by step."""

    arm: ArmModel
    program: Program
    findings: FindingList
    _grip: GraspState = field(init=False)
    _obstacles: Obstacles = field(init=False)
    _load: tuple[float, int] | None = None  # weight (N), declaring step

    def __post_init__(self) -> None:
        self._grip = GraspState(self.program, self.arm.hand)
        self._obstacles = Obstacles(self.program)

    def forget(self) -> None:
        """Forget the state of the hand. Call this method at a step that only a jump reaches, because the hand may hold
        another object after the jump.
        """
        self._grip, self._load = GraspState(self.program, self.arm.hand), None

    def follow(self, number: int, step: Step) -> None:
        """Apply the effect of a step."""
        self._grip.follow(number, step)
        match step.operation:
            case Load(weight=weight):
                self._load = (weight, number) if weight > 0 else None

    def clear(self, number: int, step: Step, q: Array) -> None:
        """Check that the hand and its load are clear of obstacles at configurations `q`, shape (N, n)."""
        X_WT, grip, goal = forward(self.arm, q), self._grip, step.operation.goal_position
        for boxes, held in ((grip.fingers, None), (grip.load, grip.held)):
            judged = held is None and goal is not None
            crossing = table_crossing(X_WT, boxes, goal=judged)
            crossing = crossing or self._obstacles.crossing(X_WT, boxes, goal=judged)
            if crossing is not None:
                position = goal if crossing.at_end else None
                self.findings.add(
                    RunsInto(
                        step=number, position=position, fixture=crossing.what, depth=crossing.depth,
                        along=crossing.along, at_end=crossing.at_end, held=held, grasp=grip.taken,
                    )
                )  # fmt: skip
                return  # one finding for each motion is enough

    def strong(self, number: int, q: Array, demands: Sequence[Demand]) -> None:
        """Check that the arm can carry its load at the configurations `q` of a motion, shape (N, n). Check also that,
        at both ends of the motion, the arm can exert the forces and moments in `demands`.
        """
        weight = 0.0
        if self._load is not None:
            weight, declared = self._load
            weak = weakness(self.arm, q[::LOAD_STRIDE], np.array([0.0, 0.0, weight]))
            if weak is not None:
                self._load = None
                self.findings.add(
                    TooHeavy(step=number, weight=weight, declared=declared, joint=weak.joint, most=weak.most)
                )
                return
        for demand in demands:
            wanted, turning = demand.exerted
            weak = weakness(self.arm, q[[0, -1]], np.array(wanted), turning=turning, weight=weight)
            if weak is not None:
                found = TooWeak(
                    step=number, exerted=demand.exerted, guard=demand.guard, joint=weak.joint, most=weak.most
                )
                self.findings.add(found)
                return

    def told_from_friction(self, number: int, q: Array, demands: Sequence[Demand]) -> None:
        """Check that the limits of guards can be distinguished from the expected friction at the start `q` of a
        motion.
        """
        expected = np.array(self.arm.compliance.friction)
        for demand in demands:
            most = faint(self.arm, q, expected, demand.exerted) if demand.guard else None
            if most is not None:
                self.findings.add(TooFaint(step=number, exerted=demand.exerted, felt=most))
