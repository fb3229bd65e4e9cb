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

    q: Array | None = None
    """Shape (n,), rad and m; None if there is no solution."""
    reason: Reason | None = None
    """None if there is one."""
    along: float | None = None
    """Of motions: how far along the way of the hand it is, m."""

    def message(self, arm: ArmModel) -> str:
        """Sentence on why there is no solution; empty if there is one."""
        return "" if self.reason is None else sentence(arm, self.reason)

    def cause(self, arm: ArmModel, goal: str = "") -> BeyondArm:
        """Why there is no solution, as the cause of an error; there must be none.

        Args:
            goal: the position that was to be reached, if it has a name.
        """
        # solvers compute with the numbers of arrays, which do not go to disk
        plain = msgspec.to_builtins(self.reason, enc_hook=np.generic.item)
        return BeyondArm(goal=goal, reason=msgspec.convert(plain, Reason), arm=ArmNames.of(arm))
