"""The worlds of the insertion bench. The errors of arm and hand are drawn as for every cell of the Stanford arm; the
bench adds one hole.
"""

from dataclasses import dataclass
from typing import Final, Self

from handeye.core.distributions import Normal, Range
from handeye.core.faults import Catalogue, ExpectedDetection, FaultKind
from handeye.core.variation import Quantity, Variation, WorldSpec
from handeye.tasks.inserting import CHAMFER, CLEARANCE, SPREAD
from handeye.tasks.stanford_cell.arm_variation import arm, hand, rubbing
from handeye.tasks.stanford_cell.arm_world import ArmWorld, arm_values

REACH: Final = 40.0  # greatest displacement of the hole along an axis, mm
_RUBBING: Final = ("pad", "part")


def _hole() -> tuple[Quantity, ...]:
    place = "Position of the hole, relative to its taught position."
    return (
        Quantity(
            name="hole.clearance", unit="mm", distribution=Range(CLEARANCE, CLEARANCE), nominal=CLEARANCE,
            limits=(0.01, 3.0), source="Diameter of the hole minus the diameter of the pin's nose.",
        ),
        Quantity(
            name="hole.chamfer", unit="mm", distribution=Range(CHAMFER, CHAMFER), nominal=CHAMFER,
            limits=(0.0, 3.0), source="Width of the 45 degree chamfer around the hole; 0 if the edge is sharp.",
        ),
        *(
            Quantity(
                name=f"plate.{axis}", unit="mm", distribution=Normal(SPREAD), limits=(-REACH, REACH), source=place
            )
            for axis in "xy"
        ),
    )  # fmt: skip


VARIATION: Final = Variation(*arm(), *hand(), *rubbing(_RUBBING), *_hole())  # the quantities of the bench

NO_PIN: Final = "pin.absent"
FAULTS: Final = Catalogue(
    FaultKind(
        name=NO_PIN, meaning="There is no pin in the holder.", when="before", expected=ExpectedDetection(errors=(2,))
    )
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class InsertionWorld(ArmWorld):
    """One world of the insertion bench, with the values drawn for it."""

    clearance: float  # diameter of the hole minus diameter of the pin's nose, m
    chamfer: float  # width of the chamfer around the hole, m
    plate: tuple[float, float]  # displacement of the hole, x and y, m
    empty: bool = False  # there is no pin in the holder

    @classmethod
    def draw(cls, spec: WorldSpec) -> Self:
        """Draw the world of a specification. Raises InvalidInput if the specification does not fit this task."""
        world = VARIATION.draw(spec)
        FAULTS.check(spec.faults)
        return cls(
            **arm_values(world, _RUBBING),
            clearance=world["hole.clearance"],
            chamfer=world["hole.chamfer"],
            plate=(world["plate.x"], world["plate.y"]),
            empty=any(fault.name == NO_PIN for fault in spec.faults),
        )
