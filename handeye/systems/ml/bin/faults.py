"""The faults that the job `bin` can have. The program of the job prints numbers; this module also has the sentence
that each number stands for.
"""

from typing import Final

from handeye.core.faults import Catalogue
from handeye.systems.ml.bench.faults import arm_fault, planted
from handeye.systems.ml.bench.reporting import calls_of

TROUBLES: Final = {
    "1": "the bin still has parts that the hand cannot take out",
    "2": "the hand has lost a part on the way",
    "3": "the range finder does not show that the hand has come down",
    "4": "a finger's gauge does not feel the table",
    "5": "the fingers do not open",
    "6": "a part stays in the open hand",
    "7": "the hand cannot go down into a box",
    "8": "the bin is empty, but the boxes hold fewer parts than were poured into the bin",
}  # sentences by the numbers that the program prints
_LEFT, _LOST, _RANGE, _GAUGE, _SHUT, *_, _MISSING = calls_of(TROUBLES)
EMPTY, WIDE, HEAVY = "bin.empty", "part_1.wide", "part_1.heavy"
FAULTS: Final = Catalogue(
    arm_fault("range.frozen", _RANGE),
    arm_fault("range.silent", _RANGE),
    arm_fault("gauge.left.z.dead", _GAUGE),
    arm_fault("gauges.dead", _GAUGE),
    arm_fault("motor.z.dead"),
    arm_fault("motor.x.dead"),
    arm_fault("motor.roll.dead"),
    arm_fault("motor.separation.dead", _SHUT),
    arm_fault(
        "motor.separation.weak", _LEFT, _LOST,
        harmless="Even the weak motor has enough force to close the fingers.",
    ),
    arm_fault("potentiometer.x.stuck"),
    planted(EMPTY, "No parts were poured into the bin.", _MISSING),
    planted(WIDE, "The first part is 3 mm too wide, as if it were a part of another kind.", _LEFT),
    planted(HEAVY, "The first part is made of steel, as if it were a part of another kind.", _LEFT),
)  # fmt: skip
