"""The faults that the job `follow` can have."""

from typing import Final

from handeye.core.faults import Catalogue, Size
from handeye.systems.ml.bench.faults import arm_fault, planted
from handeye.systems.ml.follow.circuit import EVERYWHERE, NOTHING

_NOTHING: Final = f"the follower is lost: {NOTHING} ({{felt}})"
_EVERYWHERE: Final = f"the follower is lost: {EVERYWHERE} ({{felt}})"
MISSING, MOVED, SLIPPERY = "plate.missing", "plate.moved.x", "plate.slippery"
FAULTS: Final = Catalogue(
    arm_fault("wand.open", _NOTHING),
    arm_fault("wand.closed", _EVERYWHERE),
    arm_fault("motor.x.dead"),
    arm_fault("motor.y.dead"),
    arm_fault("motor.x.slow", harmless="A slow slide still reaches its goals."),
    arm_fault("potentiometer.y.stuck"),
    planted(MISSING, "No plate lies on the table.", _NOTHING),
    planted(
        MOVED, "The plate is displaced along x by this distance.", _NOTHING,
        harmless="The follower finds the plate if the plate lies ahead of the wand.",
        size=Size(unit="mm", usual=30.0, limits=(-60.0, 60.0)),
    ),
    planted(
        SLIPPERY, "The table is oiled: the friction coefficient between plate and table has this value.",
        harmless="The force of the wand is too small to move the plate.",
        size=Size(unit="", usual=0.1, limits=(0.01, 0.25)),
    ),
)  # fmt: skip
