"""The plan: a program together with the motions of one arm. A plan has a format version, uses SI units, and is
self-contained.

Everything that passes from planning to execution is in the plan.
"""

from typing import Final

from handeye.core.record import Record
from handeye.program.program import Program

VERSION: Final = 3  # version of the format on disk
PLANNER: Final = 1  # version of the planner; another version may plan other motions for the same script

Joints = tuple[float, ...]  # one for each joint of the arm, rad or m


class PlannedMotion(Record, frozen=True, kw_only=True):
    """A planned motion: the joint positions that it passes (rad and m), and the seconds between them."""

    knots: tuple[Joints, ...]
    """Start, lift-off, via points, set-down and goal of a Move, or start and goal of a straight motion or an arc.
    """
    times: tuple[float, ...]  # duration of each segment between knots, s


class Plan(Record, frozen=True, kw_only=True):
    """A program, together with the motions that one arm makes to execute it."""

    format: str = "handeye plan"
    version: int = VERSION
    task: str  # name of the task; the plan is for this task's arm and cell
    arm: str  # name of the arm model
    arm_digest: str  # digest of the arm model's figures: a plan runs only on the arm for which it was made
    speed: float  # speed of free motions as a share of the arm's limits
    program: Program
    motions: dict[int, PlannedMotion]  # planned motion of each step that moves the arm, by step number

    @property
    def joint_counts(self) -> tuple[int, ...]:
        """The numbers of joints that occur in the motions. In a valid plan, all motions have the same number of
        joints.
        """
        return tuple(sorted({len(knot) for motion in self.motions.values() for knot in motion.knots}))
