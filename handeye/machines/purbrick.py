"""The Purbrick arm: the specification that its manual would contain, in agreement with the arm's scene.

The paper describes six axes (two of them belong to the platter), two fingers, and a force sensor in one finger, but
gives no dimensions. The authors of handeye chose or measured all numbers; scenes/purbrick_arm/README.md says which are
chosen and which are measured.
"""

import math
from typing import Final

from handeye.machines.arm_machine import ArmMachine, HandlingLimits
from handeye.ports.axes import AxisSpec, Channel

_TURN: Final = math.radians(170)

PURBRICK: Final = ArmMachine(
    name="purbrick",
    scene_file="purbrick_arm/purbrick.xml",
    period=0.01,
    axes=(  # x and y: place of the hand over the platter
        AxisSpec(name="x", kind="prismatic", lower=-0.2, upper=0.2, speed=0.2),
        AxisSpec(name="y", kind="prismatic", lower=-0.2, upper=0.2, speed=0.2),
        AxisSpec(name="z", kind="prismatic", lower=0.0, upper=0.3, speed=0.2),
        AxisSpec(name="roll", kind="revolute", lower=-_TURN, upper=_TURN, speed=1.0),
        AxisSpec(name="pitch", kind="revolute", lower=-_TURN, upper=_TURN, speed=1.0),
        AxisSpec(name="yaw", kind="revolute", lower=-_TURN, upper=_TURN, speed=1.0),
    ),
    # if the goal did not move at this speed but jumped, the fingers would strike a block at .8 m/s
    hand=AxisSpec(name="hand", kind="prismatic", lower=0.0, upper=0.048, speed=0.2, force=30.0),
    force=Channel(name="force", unit="N", width=3),
    force_sensor="strain",
    limits=HandlingLimits(
        acceleration=(
            0.8,
            0.8,
            0.8,
            10.0,
            10.0,
            10.0,
        ),  # at 1.2 m/s2, a stack of 20 blocks, 30 mm wide, falls over
        guarded_speed=(0.015, 0.015, 0.015, 0.2, 0.2, 0.2),
        settling=0.15,
        standing=(*3 * (1e-3,), *3 * (1e-2,)),  # 100 N push the platter's servo this far
        lag=0.03,  # the servos lag by .02 s
        open=0.048,
        closed=-0.020,  # the hand cannot reach this goal, so it presses with all its force
        grasping=0.2,
        carried=0.28,  # an ounce, the weight of a block
        # Measured on the way back: at most 1.8 N if closed fingers return to a stack of four blocks, but 5.8 N or more
        # if a block had been pressed onto the stack a third of a millimetre too deep.
        resistance=3.0,
    ),
)
