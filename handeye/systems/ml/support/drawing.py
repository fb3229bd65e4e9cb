"""The drawing of the rail support: its parts, and their places at the work station. Places are in units of the slides
(.001 in); lengths are in mm.
"""

from math import pi
from typing import Final, NamedTuple

from handeye.cell.threads import THREAD_FRICTION
from handeye.core.distributions import Noise, Range
from handeye.core.units import MILLIMETRE
from handeye.core.variation import Variation
from handeye.systems.ml.bench.world import ARM, ArmWorld, quantity
from handeye.systems.ml.machine.spec import LINEAR
from handeye.tasks.stanford_cell.screws import Place

UNIT: Final = LINEAR / MILLIMETRE

SCREWS: Final = 10
SADDLES: Final = tuple(f"saddle_{n}" for n in range(1, 6))
RAILS: Final = ("rail_1", "rail_2")
PINS: Final = tuple(f"pin_{n}" for n in range(1, 5))
PARTS: Final = 1 + len(SADDLES) + len(RAILS) + len(PINS) + SCREWS

# The frame lies in its nest. Ribs across it hold the saddles, walls along it the rails, and bores the pins.
FRAME: Final = (112.0, 196.0, 24.0)
FRAME_MASS: Final = 0.5  # kg: it is hollow
ROWS: Final = (-1800, -600, 600, 1800, 3000)  # y of the saddles
RIBS: Final = (-2400, -1200, 0, 1200, 2400, 3600)  # y of the ribs
RIB: Final = (60.0, 10.0)  # length along x, height
RIB_LEAD: Final = 2.5
RIB_PLAY: Final = 0.25  # between a rib and a saddle
HOLES: Final = 900  # of a saddle, on both sides of its middle, along x
RAIL_X: Final = 1750  # of the rails, on both sides of the middle of the frame
WALL: Final = (5.0, 6.0)  # thickness and height
WALL_LEAD: Final = 2.0
WALL_PLAY: Final = 0.4
PIN_PLACES: Final = ((-1750, -3300), (1750, -3300), (-1750, 3300), (1750, 3300))
PIN_BORE: Final = 4.3
PIN_DEPTH: Final = 16.0

SADDLE: Final = (60.0, 18.0, 8.0)
SADDLE_BORE: Final = 4.2  # radius: its play of 1.1 mm exceeds the errors of frame, saddle and hand together
HUB: Final = (14.0, 14.0, 20.0)  # on the middle of a saddle, where the hand holds it
RAIL: Final = (12.0, 130.0, 20.0)

NEST: Final = (3500, 0)
NEST_PLAY: Final = 0.3  # between the frame and each stop
STOP: Final = (14.0, 16.0)  # thickness and height
STOP_LEAD: Final = 6.0

# Pallets, dispenser, and the rack of the screwdriver
FRAME_PALLET: Final = (-4500, -4500)
SADDLE_PALLET: Final = ((-7500, 1500), (0, 1200))  # the first place, and the distance to each next one
RAIL_PALLET: Final = ((-4500, 5500), (1500, 0))
PIN_PALLET: Final = ((-5000, 1500), (1200, 0))
PALLET: Final = 20.0  # height of the pallet of the pins
DISPENSER: Final = ((500, 7500), (800, 0))
DISPENSER_HEIGHT: Final = 30.0
RACK: Final = (8500, -6500)
RACK_HEIGHT: Final = 60.0
RACK_PLAY: Final = 0.3
RACK_LEAD: Final = 4.0

DRIVER: Final = (25.4, 50.0)  # width and height of the block of the screwdriver
DRIVER_MASS: Final = 0.3  # kg
BIT: Final = 50.0  # distance of the face of the bit below the block

_PLAY, _TURNED, _FIXTURE, _FRICTION, _HOLE, _CURRENT = (
    "support.play",
    "support.turned",
    "support.fixture",
    "support.friction",
    "support.hole",
    "support.torque_noise",
)
PARTS_VARY: Final = (
    quantity(
        _PLAY,
        "mm",
        Noise(0.1),
        5.0,
        "Standard deviation of a part's position on its pallet along x and y. No source: our choice, which suits a "
        "play of .2 mm between part and pallet.",
    ),
    quantity(
        _TURNED,
        "deg",
        Noise(0.2),
        5.0,
        "Standard deviation of a part's rotation on its pallet. No source: our choice.",
    ),
    quantity(
        _FIXTURE,
        "mm",
        Noise(0.1),
        5.0,
        "Standard deviation of the taught position of nest, pallets, dispenser and rack along x and y. No source: "
        "our choice.",
    ),
    quantity(
        _HOLE,
        "mm",
        Noise(0.015),
        0.5,
        "Standard deviation of the position of a hole along x and y. No source: our choice.",
    ),
    quantity(
        _FRICTION,
        "",
        Range(0.87, 1.13),
        2.0,
        "Friction of the threads, as a multiple of its nominal value. No source: our choice, the same range as for "
        "the screws of the pump's plate.",
        1.0,
    ),
    quantity(
        _CURRENT,
        "N m",
        Noise(0.004),
        0.1,
        "Standard deviation of the noise in the torque that the screwdriver's current indicates. No source: our "
        "choice.",
    ),
)
VARIATION: Final = Variation(*ARM, *PARTS_VARY)


class Lie(NamedTuple):
    """Where a part or a fixture lies, in scene coordinates (mm and rad)."""

    at: Place
    turned: float = 0.0


def mm(x: float, y: float) -> Place:
    """Convert a place of the slides to scene coordinates. The y axis of the slides points away from the base."""
    return Place(x * UNIT, -y * UNIT)


def row(places: tuple[tuple[int, int], tuple[int, int]], number: int) -> tuple[int, int]:
    """Return the place that has the number `number` in a row of places. The distance between neighbours is the same
    along the whole row.
    """
    (x, y), (dx, dy) = places
    return x + number * dx, y + number * dy


class Drawing:
    """The parts, fixtures and screws of a world, with the errors that the world gives them."""

    def __init__(self, world: ArmWorld) -> None:
        self._world = world
        numbers = world.numbers("threads")
        self.phases = tuple(numbers.uniform(0, 2 * pi, SCREWS).round(4).tolist())
        self.friction = THREAD_FRICTION * world.value(_FRICTION)
        self.torque_noise = world.value(_CURRENT)

    def fixture(self, name: str, at: tuple[int, int]) -> Place:
        """Return the place of a fixture."""
        return self._off(name, mm(*at), _FIXTURE)

    def lie(self, name: str, at: Place) -> Lie:
        """Return how a part lies at its place on a pallet."""
        return Lie(self._off(name, at, _PLAY), self._world.normal(f"{name}.turned", _TURNED))

    def hole(self, name: str, at: Place) -> Place:
        """Return the place of a hole."""
        return self._off(name, at, _HOLE)

    def _off(self, name: str, at: Place, sigma: str) -> Place:
        x, y = (self._world.normal(f"{name}.{axis}", sigma) / MILLIMETRE for axis in "xy")
        return Place(at.x + x, at.y + y)
