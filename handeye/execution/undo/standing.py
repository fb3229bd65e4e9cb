"""What the hand brings back may stand on its support before the way back ends.

Something that was let go above its support, stuck on pins, falls; the hand takes it again where it let go of it, lower
in its fingers. Brought back to where it was grasped, it stands while the hand is still as far above as it had fallen.
There the hand lets go of it.
"""

from collections.abc import Callable
from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.core.units import INCH
from handeye.execution.context import ExecutionContext
from handeye.execution.undo.done import Done
from handeye.execution.undo.way import Way

FALLEN: Final = 0.31 * INCH
"""m that it may have fallen. By the pump's gasket: fingers reach .25 in through it (`[gasket_stand]`), and it is .06 in
thick; fallen much farther, they would not hold it again. Measured: 6.0 and 6.7 mm, seeds 8128 and 8124; 8.05, held all
the same, in 8724, which this stops: the arm is not just as high as it believes."""


def stands(run: ExecutionContext, way: Way, grasps: Callable[[Done], bool]) -> bool:
    """Does what resists tell that it stands? The way leads to where it was grasped, and the hand is nearly there.

    Args:
        grasps: a step is one in which fingers take hold, or hold more firmly.
    """
    if not run.state.grasping or not _grasped_before(run, grasps):
        return False
    ahead = forward(run.arm, run.drive.state.q)[:3, 3] - forward(run.arm, way.q[0])[:3, 3]
    return float(np.linalg.norm(ahead)) <= FALLEN


def where_the_hand_is(run: ExecutionContext, way: Way) -> Way:
    """The way of a grasp, gone where the arm is now: it may have stopped above, where what it brought back stood."""
    return Way(q=way.q + (run.drive.state.q - way.q[-1]), gap=way.gap)


def _grasped_before(run: ExecutionContext, grasps: Callable[[Done], bool]) -> bool:
    """Nothing moved but the fingers between the step in which they took hold and the last one."""
    for done in reversed(run.state.done[:-1]):
        if not done.way:
            continue
        if not grasps(done):
            return False
        if not done.grasping:
            return True
    return False
