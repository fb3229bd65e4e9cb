"""Variation of the insertion bench: the arm and the hand of the pump's worlds, and one hole."""

from dataclasses import dataclass
from typing import Final, Self

from handeye.core.distributions import Normal, Range
from handeye.core.variation import Quantity, Variation, World, WorldSpec
from handeye.tasks.inserting import CHAMFER, CLEARANCE, SPREAD
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.tasks.water_pump.world.variation import variation as pump_variation

REACH: Final = 40.0
"""How far off the hole can be along an axis, mm."""
_TAKEN: Final = ("arm", "hand", "friction.pad", "friction.part")
"""What the bench has of the pump's world."""
_PUMP: Final = pump_variation(0)


def _hole() -> tuple[Quantity, ...]:
    place = "Where the hole is, against where the program was taught it is."
    return (
        Quantity(
            name="hole.clearance", unit="mm", distribution=Range(CLEARANCE, CLEARANCE), nominal=CLEARANCE,
            limits=(0.01, 3.0), source="Diameter of the hole over that of the pin's nose.",
        ),
        Quantity(
            name="hole.chamfer", unit="mm", distribution=Range(CHAMFER, CHAMFER), nominal=CHAMFER,
            limits=(0.0, 3.0), source="Width of the 45 degree chamfer around the hole; 0: its edge is sharp.",
        ),
        *(
            Quantity(
                name=f"plate.{axis}", unit="mm", distribution=Normal(SPREAD), limits=(-REACH, REACH), source=place
            )
            for axis in "xy"
        ),
    )  # fmt: skip


VARIATION: Final = Variation(*(each for group in _TAKEN for each in _PUMP.select(group)), *_hole())
"""The quantities of the bench."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BenchWorld:
    """One drawn world of the bench."""

    pump: PumpWorld
    """Its arm, its hand and how things rub; all else in it is as drawn in a nominal one."""
    clearance: float
    """Of the hole, in diameter, m."""
    chamfer: float
    """m"""
    plate: tuple[float, float]
    """How far the hole is off, x and y, m."""

    @classmethod
    def draw(cls, spec: WorldSpec) -> Self:
        """The world of a specification.

        Raises:
            InvalidInput: it cannot be drawn here.
        """
        world = VARIATION.draw(spec)
        right = {each.name: each.nominal * each.measure.size for each in _PUMP.quantities.values()}
        return cls(
            pump=PumpWorld.of(World(spec=spec, values={**right, **world.values})),
            clearance=world["hole.clearance"],
            chamfer=world["hole.chamfer"],
            plate=(world["plate.x"], world["plate.y"]),
        )
