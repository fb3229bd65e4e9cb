"""Taught data for the examples of `handeye explain` and of the manual."""

from typing import Final

from handeye.core.obb import Box
from handeye.core.units import DEGREE, INCH
from handeye.program.program import Fixture, Held, Hole, Part, Position
from handeye.program.taught import Taught

_DOWN: Final = (90 * DEGREE, 90 * DEGREE, 0.0)


def _position(x: float, y: float, z: float) -> Position:
    return Position(at=(x * INCH, y * INCH, z * INCH, *_DOWN))


def _box(x: float, y: float, low: float, high: float) -> Box:
    return (-x * INCH, -y * INCH, low * INCH, x * INCH, y * INCH, high * INCH)


SAMPLE: Final = Taught(
    positions={
        "PARK": _position(20, 28, 8),
        "P": _position(18, 44, 3),
        "T": _position(25, 38, 4),
        "LOW": _position(25, 38, -1),
        "FAR": _position(200, 38, 4),
    },
    parts={
        "BASE": Part(
            at=(25 * INCH, 38 * INCH, 0.0, 0.0),
            holes=(Hole(x=0.0, y=0.0, diameter=2 * INCH), Hole(x=3 * INCH, y=0.0, diameter=INCH)),
            region=(3 * INCH, 3 * INCH),
            outline=(-2 * INCH, -2 * INCH, 4 * INCH, 2 * INCH),
        ),
        "GASKET": Part(at=(26 * INCH, 48 * INCH, 0.0, 0.0)),
    },
    fixtures={"STAND": Fixture(at=(32 * INCH, 46 * INCH, 0.0, 0.0), boxes=(_box(2, 2, 0, 1.75),))},
    held={"STICK": Held(positions=("P",), boxes=(_box(0.2, 0.2, -0.5, 2.5),))},
)
