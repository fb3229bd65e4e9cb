"""The limits within which the Stanford arm handles parts while a program commands its tool axes."""

from typing import Final

from handeye.core.units import INCH
from handeye.machines.arm_machine import HandlingLimits

LIMITS: Final = HandlingLimits(
    acceleration=(*3 * (0.4,), *3 * (4.0,)),
    guarded_speed=(
        *3 * (0.01,),
        *3 * (0.1,),
    ),  # at this speed, a descent stops 1.5 N beyond its limit or earlier
    settling=0.15,
    standing=(*3 * (3e-3,), *3 * (2e-2,)),  # chosen: friction holds the joints this far off
    lag=0.05,
    open=1.3 * INCH,  # around a pin in its holder
    closed=-0.02,  # beyond any gap, so that the fingers press with all their force
    grasping=0.4,
    carried=5.0,  # the arm feels up to 2.5 N in free air at .025 m/s
    resistance=14.0,  # the arm feels up to 7 N in free air at .2 m/s; twice as much is an obstacle
)
"""Limits of the arm, from the forces that it feels in free air (`handeye/execution/tool_axes.py`). The limits belong
to the arm, and not to a program.
"""
