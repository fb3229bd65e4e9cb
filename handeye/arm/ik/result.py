"""Results of inverse kinematics."""

from dataclasses import dataclass

import msgspec
import numpy as np

from handeye.arm.model import ArmModel
from handeye.core.pose import Array
from handeye.program.diagnosis.causes import ArmNames, BeyondArm
from handeye.program.diagnosis.reach import ReachFailure
from handeye.program.diagnosis.reach_text import reach_sentence


@dataclass(frozen=True, slots=True, kw_only=True)
class IKResult:
    """Joint positions for a hand pose, or why there are none for it or for a motion."""

    q: Array | None = None  # shape (n,), rad and m
    reason: ReachFailure | None = None  # why there is no solution
    along: float | None = None  # of motions: m along the hand's path

    def message(self, arm: ArmModel) -> str:
        """The reason as a reach_sentence, or ""."""
        return "" if self.reason is None else reach_sentence(arm, self.reason)

    def cause(self, arm: ArmModel, goal: str = "") -> BeyondArm:
        """The failure as the cause of an error; `goal` is the position's name, if it has one."""
        # solvers compute with the numbers of arrays, which do not go to disk
        plain = msgspec.to_builtins(self.reason, enc_hook=np.generic.item)
        return BeyondArm(goal=goal, reason=msgspec.convert(plain, ReachFailure), arm=ArmNames.of(arm))
