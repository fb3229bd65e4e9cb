"""The faults that the job `orient` can have. The program of the job prints numbers; this module also has the sentence
that each number stands for.
"""

from typing import Final

from handeye.core.faults import Catalogue, Size
from handeye.systems.ml.bench.faults import arm_fault, planted
from handeye.systems.ml.bench.reporting import calls_of

TROUBLES: Final = {
    "1": "the hand has met something on its way down",
    "2": (
        "the hand holds no bar, holds a bar of another width, or does not hold the bar by its sides; or the "
        "fingers are weak"
    ),
    "3": "the bar meets nothing where the table should be, or the gauges do not feel the contact",
    "4": "the bar does not lie flat on the table",
    "5": "the bar does not meet the stop, or the gauges do not feel the contact",
    "6": "the fingers do not open",
}  # sentences by the numbers that the program prints
_MET, _NONE, _NO_TABLE, _TILTED, _NO_STOP, _SHUT = calls_of(TROUBLES)
MISSING, NARROW, WIDE, SHORT, CRADLE, NO_STOP, STOP = (
    "bar.missing",
    "bar.narrow",
    "bar.wide",
    "bar.short",
    "cradle.moved.x",
    "stop.missing",
    "stop.moved.y",
)
FAULTS: Final = Catalogue(
    arm_fault("gauge.left.z.dead", harmless="The gauge of the right finger stops the hand."),
    arm_fault("gauge.left.y.dead", harmless="The gauge of the right finger feels the stop."),
    arm_fault("gauges.dead", _NO_TABLE),
    arm_fault("motor.z.dead"),
    arm_fault("motor.y.dead"),
    arm_fault("motor.separation.dead", _SHUT),
    arm_fault("motor.separation.weak", _NONE, _TILTED, harmless="A bar weighs only 26 g."),
    arm_fault("potentiometer.y.stuck"),
    planted(MISSING, "There is no bar in the cradle.", _NONE),
    planted(NARROW, "The bar is 3 mm too narrow.", _NONE),
    planted(WIDE, "The bar is 3 mm too wide.", _NONE),
    planted(SHORT, "The bar is 4 mm too short."),
    planted(
        CRADLE, "The cradle with its bar is displaced along x by this distance.", _MET, _NONE,
        size=Size(unit="mm", usual=30.0, limits=(20.0, 60.0)),
    ),
    planted(NO_STOP, "There is no stop.", _NO_STOP),
    planted(
        STOP, "The stop is displaced along y by this distance.",
        size=Size(unit="mm", usual=5.0, limits=(2.0, 20.0)),
    ),
)  # fmt: skip
