"""The faults that the job `train` can have. The program of the job prints numbers; this module also has the sentence
that each number stands for.
"""

from typing import Final

from handeye.core.faults import Catalogue, Size
from handeye.systems.ml.bench.faults import arm_fault, planted
from handeye.systems.ml.bench.reporting import calls_of

TROUBLES: Final = {
    "1": "the hand has met something on its way down",
    "2": "the hand holds no vehicle, or the wrong vehicle",
    "3": "the peg does not go into its hole",
    "4": "a wagon has not followed the engine, or the gauges do not feel the wagon",
    "5": "the fingers do not open",
}  # sentences by the numbers that the program prints
_MET, _NONE, _NO_HOLE, _LEFT, _SHUT = calls_of(TROUBLES)
NO_ENGINE, NO_WAGON, MOVED, REVERSED, THICK, NO_PEG, BLOCKED = (
    "engine.missing",
    "wagon_2.missing",
    "wagon_1.moved.x",
    "wagon_1.reversed",
    "wagon_1.peg.thick",
    "wagon_2.peg.missing",
    "engine.hole.blocked",
)
FAULTS: Final = Catalogue(
    arm_fault("gauge.left.z.dead", harmless="The gauge of the right finger stops the hand."),
    arm_fault("gauges.dead", _LEFT),
    arm_fault("motor.z.dead"),
    arm_fault("motor.y.dead"),
    arm_fault("motor.separation.dead", _SHUT),
    arm_fault("motor.separation.weak", _NONE, harmless="The vehicles are so light that weak fingers can hold them."),
    arm_fault("potentiometer.z.stuck"),
    planted(NO_ENGINE, "There is no engine.", _NONE),
    planted(NO_WAGON, "There is no second wagon.", _NONE),
    planted(
        MOVED, "The first wagon is displaced along x by this distance.", _MET, _NONE,
        size=Size(unit="mm", usual=40.0, limits=(20.0, 60.0)),
    ),
    planted(REVERSED, "The first wagon stands the wrong way round.", _MET, _NO_HOLE, _NONE),
    planted(THICK, "The peg of the first wagon is 1 mm too thick.", _NO_HOLE),
    planted(NO_PEG, "The second wagon has no peg.", _LEFT),
    planted(BLOCKED, "The hole of the engine is blocked.", _NO_HOLE),
)  # fmt: skip
