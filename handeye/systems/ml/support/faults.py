"""The faults that the job `support` can have. The program of the job prints numbers; this module also has the sentence
that each number stands for.
"""

from typing import Final

from handeye.core.faults import Catalogue
from handeye.systems.ml.bench.faults import arm_fault, planted
from handeye.systems.ml.bench.reporting import calls_of

TROUBLES: Final = {
    "1": "the hand has met something on its way down",
    "2": "the hand holds no part, or the wrong part",
    "3": "a part, or the screwdriver, does not sit fully in its place",
    "4": "the bit finds no screw in the dispenser",
    "5": "a screw finds no thread",
    "6": "a screw does not become tight",
}  # sentences by the numbers that the program prints
_MET, _NONE, *_ = calls_of(TROUBLES)
MAY_LACK: Final = ("frame", "rail_1", "pin_1")
FAULTS: Final = Catalogue(
    arm_fault("motor.z.dead"),
    arm_fault("motor.x.dead"),
    arm_fault("motor.roll.dead"),
    arm_fault("potentiometer.z.stuck"),
    *(planted(f"{part}.missing", f"There is no {part}.", _NONE) for part in MAY_LACK),
)
