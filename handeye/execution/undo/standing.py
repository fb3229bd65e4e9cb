"""Detects that a returned object stands on its support before the path back ends.

An object let go above its support, stuck on pins, falls; the hand takes it again where it let go, lower in its fingers.
Brought back to where it was grasped, it stands while the hand is still as far above as it had fallen. There the hand
lets go of it.
"""

from collections.abc import Callable
from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.core.units import INCH
from handeye.execution.context import ExecutionContext
from handeye.execution.undo.done import ExecutedStep
from handeye.execution.undo.way import RecordedPath

FALLEN: Final = 0.31 * INCH
"""m that it may have fallen. By the pump's gasket: fingers reach .25 in through it (`[gasket_stand]`), and it is .06 in
thick; fallen much farther, they would not hold it again. Measured: 6.0 and 6.7 mm, seeds 8128 and 8124; 8.05, held all
the same, in 8724, which this stops: the arm's height is not exact.
"""


def stands(run: ExecutionContext, way: RecordedPath, grasps: Callable[[ExecutedStep], bool]) -> bool:
    """True if resistance shows that it stands: the path leads to its grasp, and the hand is nearly there.

    `grasps`: whether a step takes hold, or holds more firmly.
    """
    if not run.state.grasping or not _grasped_before(run, grasps):
        return False
    ahead = forward(run.arm, run.drive.state.q)[:3, 3] - forward(run.arm, way.q[0])[:3, 3]
    return float(np.linalg.norm(ahead)) <= FALLEN


def where_the_hand_is(run: ExecutionContext, way: RecordedPath) -> RecordedPath:
    """The path of a grasp, shifted to where the arm is now, which may be above."""
    return RecordedPath(q=way.q + (run.drive.state.q - way.q[-1]), gap=way.gap)


def _grasped_before(run: ExecutionContext, grasps: Callable[[ExecutedStep], bool]) -> bool:
    """True if only the fingers moved between the grasp and the last step."""
    for done in reversed(run.state.done[:-1]):
        if not done.way:
            continue
        if not grasps(done):
            return False
        if not done.grasping:
            return True
    return False
