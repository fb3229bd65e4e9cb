"""The checks of each planned motion: what is in its way, and whether the arm is strong enough for it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.arm.model import ArmModel
from handeye.planning.clearance import Surroundings, table_crossing
from handeye.planning.grasp_state import GraspState
from handeye.planning.planning_findings import PlanningFindings
from handeye.planning.strength import weakness
from handeye.pose import Array
from handeye.program.guards import Exerted, Guards
from handeye.program.operations import Change, Load, Move
from handeye.program.program import Program, Step
from handeye.record import Vector3

SPARSE: Final = 8
"""Of so many configurations of a motion, one is enough for what a load asks of the joints."""


@dataclass(frozen=True, slots=True)
class Demand:
    """What the hand is to exert on a motion."""

    code: str
    """Of the diagnostic if the arm cannot."""
    exerted: Exerted


def to_stop(guards: Guards, along: Vector3 | None = None) -> list[Demand]:
    """Forces along a vector, and moments about one, that guards wait for in a motion `along` another."""
    waited = (guard.exerted(along) for guard in guards)
    return [Demand("stop-beyond-arm", exerted) for exerted in waited if exerted is not None]


def to_press(operation: Change) -> list[Demand]:
    """What a straight motion is to press and turn with."""
    both = ((operation.press, False), (operation.moment, True))
    exerted = (Exerted(wanted, turning) for wanted, turning in both if wanted is not None)
    return [Demand("force-beyond-arm", one) for one in exerted]


@dataclass(slots=True)
class Checks:
    """Follows a program step by step, and says what it finds."""

    arm: ArmModel
    program: Program
    objections: PlanningFindings
    _grip: GraspState = field(init=False)
    _surroundings: Surroundings = field(init=False)
    _load: tuple[float, Step] | None = None
    """Weight (N), and the step that says so; None once it was found too heavy."""

    def __post_init__(self) -> None:
        self._grip = GraspState(self.program, self.arm.hand)
        self._surroundings = Surroundings(self.program)

    def forget(self) -> None:
        """The next step is come to by a jump: whatever the hand held, it may hold something else."""
        self._grip, self._load = GraspState(self.program, self.arm.hand), None

    def follow(self, step: Step) -> None:
        """What a step does to the hand, and to what is in it."""
        self._grip.follow(step)
        if isinstance(step.operation, Load):
            self._load = (step.operation.weight, step) if step.operation.weight > 0 else None

    def clear(self, step: Step, q: Array) -> None:
        """Whether the hand and its load are clear of everything over configurations `q`, shape (N, n)."""
        X_WT, grip = forward(self.arm, q), self._grip
        for boxes, held in ((grip.fingers, None), (grip.load, grip.held)):
            goal = held is None and isinstance(step.operation, Move)
            crossing = table_crossing(X_WT, boxes, goal=goal) or self._surroundings.crossing(
                X_WT, boxes, goal=goal
            )
            if crossing is not None:
                self.objections.crosses(step, crossing, held, grip.taken)
                return  # the worst of a motion is enough

    def strong(self, step: Step, q: Array, demands: Sequence[Demand]) -> None:
        """Whether the arm holds its load up over configurations `q`, and can exert what is asked at both ends."""
        weight = 0.0
        if self._load is not None:
            weight, because = self._load
            weak = weakness(self.arm, q[::SPARSE], np.array([0.0, 0.0, weight]))
            if weak is not None:
                self._load = None
                self.objections.too_heavy(step, weight, weak, because)
                return
        for demand in demands:
            wanted, turning = demand.exerted
            weak = weakness(self.arm, q[[0, -1]], np.array(wanted), turning=turning, weight=weight)
            if weak is not None:
                self.objections.too_weak(demand.code, step, math.hypot(*wanted), weak, turning=turning)
                return
