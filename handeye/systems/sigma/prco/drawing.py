"""The drawing of the plate job: dimensions and places of all parts, and their errors in a world. All lengths are in mm,
in the coordinates of arm 1 with z up from the board.
"""

from math import pi
from typing import Final

from handeye.cell.threads import THREAD_FRICTION
from handeye.core.errors import BadArgument
from handeye.core.record import Record
from handeye.systems.sigma.gantries.world import FIXTURES, GantryWorld
from handeye.tasks.stanford_cell.screws import Place

MOST: Final = 6  # screws
PINS: Final = 2

# The base stands in a nest, and the plate lies on a stand.
NEST: Final = Place(300, 200)
STAND: Final = Place(100, 290)
BASE: Final = (158.0, 80.0, 40.0)
PLATE: Final = (154.0, 76.0, 8.0)
HUB: Final = (20.0, 20.0, 25.0)  # on the middle of the plate; a hand holds the plate by the hub
STAND_HEIGHT: Final = 20.0
PLAY: Final = 0.3  # between the base and each stop of its nest

# Holes of base and plate, from their middle. The screws are symmetric about the middle, and leave room for the open
# fingers of the other arm at the pins.
PIN_HOLES: Final = (Place(-45, 0), Place(45, 0))
SCREW_HOLES: Final = (
    Place(-62, -26),
    Place(28, -26),
    Place(62, -26),
    Place(62, 26),
    Place(-28, 26),
    Place(-62, 26),
)
PIN_BORE: Final = 4.1  # radius, in the base
PIN_DEPTH: Final = 16.0
PLATE_PIN_BORE: Final = 4.15

# A pin stands in its holder, and a screw hangs by its head in the dispenser.
HOLDER: Final = Place(100, 80)
HOLDER_PITCH: Final = 40.0
HOLDER_HEIGHT: Final = 20.0
HOLDER_BORE: Final = 4.3
DISPENSER: Final = Place(510, 100)
DISPENSER_PITCH: Final = 20.0
DISPENSER_HEIGHT: Final = 30.0

# The screwdriver of arm 2
BIT: Final = 5.0  # height of its face over the fingertips; a screw on the bit breaks the light beam

_HOLE: Final = 0.03  # greatest error of the place of a hole in x and in y
_FRICTION: Final = (0.87, 1.13)  # friction of a thread, as a multiple of its nominal friction


class Pump(Record, frozen=True, kw_only=True):
    """The parts of a world: where they stand, and how they differ from the drawing. Each hole is given by its true
    place, which includes the error of the place.
    """

    nest: Place
    stand: Place
    holder: Place
    dispenser: Place
    base_pins: tuple[Place, ...]
    base_taps: tuple[Place, ...]
    plate_pins: tuple[Place, ...]
    plate_bores: tuple[Place, ...]
    phases: tuple[float, ...]  # rad: angle at which each thread begins
    friction: float  # coefficient of the threads

    @property
    def screws(self) -> int:
        return len(self.base_taps)


def drawn(world: GantryWorld, screws: int) -> Pump:
    """Return the parts of a world. Raises BadArgument if the number of screws is impossible."""
    if not 1 <= screws <= MOST:
        raise BadArgument(f"the plate of the pump must have 1 to {MOST} screws, not {screws}")

    def fixture(name: str, at: Place) -> Place:
        x, y = (1000 * world.normal(f"{name}.{axis}", FIXTURES) for axis in "xy")
        return Place(round(at.x + x, 3), round(at.y + y, 3))

    def holes(name: str, places: tuple[Place, ...]) -> tuple[Place, ...]:
        numbers, most = world.numbers(f"{name}.holes"), 0.0 if world.spec is None else _HOLE
        off = numbers.uniform(-most, most, (len(places), 2)).round(3)
        return tuple(Place(at.x + float(x), at.y + float(y)) for at, (x, y) in zip(places, off, strict=True))

    numbers, threads = world.numbers("threads"), SCREW_HOLES[:screws]
    phases = numbers.uniform(0, 2 * pi, MOST)
    friction = 1.0 if world.spec is None else float(numbers.uniform(*_FRICTION))
    return Pump(
        nest=fixture("nest", NEST),
        stand=fixture("stand", STAND),
        holder=fixture("holder", HOLDER),
        dispenser=fixture("dispenser", DISPENSER),
        base_pins=holes("base.pins", PIN_HOLES),
        base_taps=holes("base.taps", threads),
        plate_pins=holes("plate.pins", PIN_HOLES),
        plate_bores=holes("plate.bores", threads),
        phases=tuple(float(phase) for phase in phases[:screws].round(4)),
        friction=round(THREAD_FRICTION * friction, 4),
    )


def holder_places(pump: Pump) -> tuple[Place, ...]:
    """Return the places of the pins in their holder."""
    x, y = pump.holder
    return tuple(Place(x + HOLDER_PITCH * (number - (PINS - 1) / 2), y) for number in range(PINS))


def dispenser_places(pump: Pump) -> tuple[Place, ...]:
    """Return the places of the screws in their dispenser."""
    x, y = pump.dispenser
    return tuple(Place(x + DISPENSER_PITCH * (number - (MOST - 1) / 2), y) for number in range(pump.screws))
