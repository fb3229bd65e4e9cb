"""Results of inverse kinematics."""

from dataclasses import dataclass

import msgspec
import numpy as np

from handeye.arm.model import ArmModel
from handeye.core.pose import Array
from handeye.program.causes import ArmNames, BeyondArm
from handeye.program.reason_text import sentence
from handeye.program.reasons import Reason


@dataclass(frozen=True, slots=True, kw_only=True)
class IKResult:
    """Joint positions for a hand pose, or why there are none for it or for a motion."""

    q: Array | None = None  # shape (n,), rad and m
    reason: Reason | None = None  # why there is no solution
    along: float | None = None  # of motions: m along the hand's path

    def message(self, arm: ArmModel) -> str:
        """The reason as a sentence, or ""."""
        return "" if self.reason is None else sentence(arm, self.reason)

    def cause(self, arm: ArmModel, goal: str = "") -> BeyondArm:
        """The failure as the cause of an error; `goal` is the position's name, if it has one."""
        # solvers compute with the numbers of arrays, which do not go to disk
        plain = msgspec.to_builtins(self.reason, enc_hook=np.generic.item)
        return BeyondArm(goal=goal, reason=msgspec.convert(plain, Reason), arm=ArmNames.of(arm))
