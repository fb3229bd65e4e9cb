"""The faults that the job `blocks` can have. The program of the job prints numbers; this module also has the sentence
that each number stands for.
"""

from typing import Final

from handeye.core.faults import Catalogue, Size
from handeye.systems.ml.bench.faults import arm_fault, planted
from handeye.systems.ml.bench.reporting import calls_of

TROUBLES: Final = {
    "1": "the hand has met something on its way down",
    "2": "the hand holds no block or a block of the wrong size, or the fingers are weak",
    "3": "the block meets nothing on its way down, or the gauges do not feel the contact",
    "4": "the block stops at a wrong height: something else stands on the stack, or the block has the wrong size",
    "5": "the fingers do not open",
}  # sentences by the numbers that the program prints
_MET, _NONE, _UNFELT, _HIGH, _SHUT = calls_of(TROUBLES)
MISSING, MOVED, SMALL, LARGE, OCCUPIED, SLIPPERY = (
    "block_1.missing",
    "block_2.moved.x",
    "block_1.small",
    "block_3.large",
    "stack.occupied",
    "blocks.slippery",
)
FAULTS: Final = Catalogue(
    arm_fault("gauge.left.z.dead", harmless="The gauge of the right finger stops the hand."),
    arm_fault("gauges.dead", _UNFELT),
    arm_fault("motor.z.dead"),
    arm_fault("motor.x.dead"),
    arm_fault("motor.roll.dead"),
    arm_fault("motor.separation.dead", _SHUT),
    arm_fault("motor.separation.weak", harmless="A block weighs only 16 g."),
    arm_fault("motor.z.slow", harmless="A slow slide still reaches its goals."),
    arm_fault("potentiometer.z.stuck"),
    planted(MISSING, "There is no first block.", _NONE),
    planted(
        MOVED, "The second block is displaced along x by this distance.", _MET, _NONE,
        size=Size(unit="mm", usual=30.0, limits=(15.0, 60.0)),
    ),
    planted(SMALL, "The side of the first block is 8 mm too short.", _NONE),
    planted(LARGE, "The side of the third block is 6 mm too long.", _MET, _NONE),
    planted(OCCUPIED, "A block already stands where the stack is to be built.", _HIGH),
    planted(
        SLIPPERY, "The blocks are oiled: their friction coefficient has this value.",
        harmless="The fingers press with 90 N, and a block weighs only 16 g.",
        size=Size(unit="", usual=0.1, limits=(0.01, 0.3)),
    ),
)  # fmt: skip
