"""The checks of each planned motion: what is in its way, and whether the arm is strong enough for it."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.arm.friction import MARGIN, faint, felt_friction
from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.core.pose import Array
from handeye.core.record import Vector3
from handeye.planning.collision import Surroundings, table_crossing
from handeye.planning.findings import FindingList
from handeye.planning.grasp_state import GraspState
from handeye.planning.strength import weakness
from handeye.program.findings import RunsInto, TooFaint, TooHeavy, TooWeak
from handeye.program.flow_operations import Load
from handeye.program.guards import Exerted, Guards
from handeye.program.motion_operations import Change
from handeye.program.program import Program, Step

SPARSE: Final = 8
"""One of so many configurations of a motion is checked for what a load asks of the joints."""


@dataclass(frozen=True, slots=True)
class Demand:
    """A force or moment that the hand is to exert on a motion."""

    exerted: Exerted
    guard: bool
    """A guard waits for it."""


def to_stop(guards: Guards, along: Vector3 | None = None) -> list[Demand]:
    """Forces along a vector, and moments about one, that guards wait for in a motion `along` another."""
    waited = (guard.exerted(along) for guard in guards)
    return [Demand(exerted, guard=True) for exerted in waited if exerted is not None]


def to_press(operation: Change) -> list[Demand]:
    """Force and moment that a straight motion is to press and turn with."""
    both = ((operation.press, False), (operation.moment, True))
    exerted = (Exerted(wanted, turning) for wanted, turning in both if wanted is not None)
    return [Demand(one, guard=False) for one in exerted]


@dataclass(slots=True)
class Checks:
    """Follows a program step by step, and says what it finds."""

    arm: ArmModel
    program: Program
    findings: FindingList
    _grip: GraspState = field(init=False)
    _surroundings: Surroundings = field(init=False)
    _load: tuple[float, int] | None = None
    """Weight (N), and the step that says so; None once it was found too heavy."""

    def __post_init__(self) -> None:
        self._grip = GraspState(self.program, self.arm.hand)
        self._surroundings = Surroundings(self.program)

    def forget(self) -> None:
        """The next step is reached by a jump: whatever the hand held, it may hold something else."""
        self._grip, self._load = GraspState(self.program, self.arm.hand), None

    def follow(self, number: int, step: Step) -> None:
        """Take over what a step does to the hand, and to what is in it."""
        self._grip.follow(number, step)
        match step.operation:
            case Load(weight=weight):
                self._load = (weight, number) if weight > 0 else None

    def clear(self, number: int, step: Step, q: Array) -> None:
        """Check that the hand and its load are clear of everything over configurations `q`, shape (N, n)."""
        X_WT, grip, goal = forward(self.arm, q), self._grip, step.operation.goal_position
        for boxes, held in ((grip.fingers, None), (grip.load, grip.held)):
            judged = held is None and goal is not None
            crossing = table_crossing(X_WT, boxes, goal=judged) or self._surroundings.crossing(
                X_WT, boxes, goal=judged
            )
            if crossing is not None:
                position = goal if crossing.at_end else None
                self.findings.add(
                    RunsInto(
                        step=number, position=position, fixture=crossing.what, depth=crossing.depth,
                        along=crossing.along, at_end=crossing.at_end, held=held, grasp=grip.taken,
                    )
                )  # fmt: skip
                return  # the worst of a motion is enough

    def strong(self, number: int, q: Array, demands: Sequence[Demand]) -> None:
        """Check that the arm holds its load up over configurations `q`, and can exert what is asked at both ends."""
        weight = 0.0
        if self._load is not None:
            weight, declared = self._load
            weak = weakness(self.arm, q[::SPARSE], np.array([0.0, 0.0, weight]))
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
                self.findings.add(
                    TooWeak(
                        step=number,
                        exerted=demand.exerted,
                        guard=demand.guard,
                        joint=weak.joint,
                        most=weak.most,
                    )
                )
                return

    def told_from_friction(self, number: int, q: Array, demands: Sequence[Demand]) -> None:
        """Check that what guards wait for from a configuration on can be told from the friction expected there."""
        guarded = [demand for demand in demands if demand.guard]
        felt = felt_friction(self.arm, q, np.array(self.arm.compliance.friction)) if guarded else None
        for demand in guarded:
            most = None if felt is None else faint(felt, demand.exerted)
            if most is not None:
                self.findings.add(
                    TooFaint(
                        step=number, exerted=demand.exerted, friction=most, margin=MARGIN
                    )
                )  # fmt: skip
