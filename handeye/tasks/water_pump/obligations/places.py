"""Regions of the pump's cell, with limits. A touch in one of these regions is evidence about a part. The limits of a
region say what the hand may feel there.

The places of the regions come from the drawing of the cell. The limits come from docs/care.md: each limit is a little
wider than the limit in the careful program, but not wider than docs/care.md justifies.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

from handeye.core.units import INCH, OUNCE_FORCE, OUNCE_INCH
from handeye.proof.evidence import Contact, Contacted, Limits, Region
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, screw_holes, standard, web_centre

Point = tuple[float, float]
SOCKET: Final = Limits(3.0 * INCH, 9.0 * INCH)  # heights of a hand that holds the screwdriver over the pump
TOUCH: Final = Limits(20 * OUNCE_FORCE, 60 * OUNCE_FORCE)
"""Forces at which a touch ends. They exceed the errors of the sensed force, but are too small to move the pump.
"""
PUSH: Final = Limits(40 * OUNCE_FORCE, 80 * OUNCE_FORCE)  # forces that move the pump against its blocks
SEATED: Final = Limits(
    -0.02 * INCH, 0.02 * INCH
)  # of a head: three standard deviations of a touch, and .002 in
TORQUE: Final = Limits(40 * OUNCE_INCH, 45.5 * OUNCE_INCH)  # of the torque stop; the clutch slips at .32 N m
HARD: Final = Limits(8 * OUNCE_FORCE, 16 * OUNCE_FORCE)  # at the crank: the rotor's own friction is 5.7 oz
PRESSED: Final = 0.006 * INCH  # by which six screws press the layers together


@dataclass(frozen=True)
class PumpPlaces:
    """Regions of the pump's cell, for a pump with a given number of screws."""

    screws: int

    def on_pump(self, x: float, y: float) -> Point:
        """Convert a point of the base in its standard position to the table frame (m)."""
        X = standard()
        return float(X[0, 0] * x + X[0, 1] * y + X[0, 3]), float(X[1, 0] * x + X[1, 1] * y + X[1, 3])

    @cached_property
    def holes(self) -> tuple[Point, ...]:
        return screw_holes(self.screws)

    @cached_property
    def head_height(self) -> float:
        """Height (m) of a screw head above the face of the base when six screws press the layers together."""
        d = dimensions()
        return d("gasket.thickness") + d("top.flange") + d("screw.head_height") - PRESSED

    def over_hole(self, hole: int, radius: float, low: float, high: float) -> Region:
        """Return the region above a screw hole, from `low` to `high` above the table (m)."""
        return Region(at=self.on_pump(*self.holes[hole]), radius=radius, height=Limits(low, high))

    def socket(self, hole: int) -> Region:
        return self.over_hole(hole, 0.35 * INCH, SOCKET.low, SOCKET.high)

    @cached_property
    def pump(self) -> Region:
        """The pump, and the space above it."""
        return Region(at=self.on_pump(1.0 * INCH, 0.0), radius=4.0 * INCH, height=Limits(0.0, 12 * INCH))

    @cached_property
    def face(self) -> Contact:
        """A touch of the bare face of the base."""
        height = Limits(base_top(), base_top() + 0.45 * INCH)
        return self.touched(Region(at=self.on_pump(1.0 * INCH, 0.0), radius=3.3 * INCH, height=height))

    @cached_property
    def table(self) -> Contact:
        """A touch of the table beside the base."""
        beside = Region(at=self.on_pump(1.0 * INCH, 0.0), radius=7.0 * INCH, height=Limits(0.0, 0.6 * INCH))
        return self.touched(beside)

    @cached_property
    def axis(self) -> Region:
        return Region(at=self.on_pump(0.0, 0.0), radius=0.5 * INCH, height=Limits(0.0, 12 * INCH))

    @cached_property
    def laid(self) -> Region:
        """The region in which the fingers release the gasket onto the base, and take it up again."""
        web = self.on_pump(web_centre(), 0.0)
        return Region(at=web, radius=0.5 * INCH, height=Limits(1.0 * INCH, 3.8 * INCH))

    def touched(self, where: Region) -> Contact:
        return Contact(where=where, force=TOUCH)

    def drives(self) -> tuple[Contacted, ...]:
        """Any motion that drives a screw, at any torque."""
        any_torque = Limits(0.0, 1e6)
        return (Contacted(of=Contact(where=self.pump, torque=any_torque)),)


def point(name: str) -> Point:
    """Return the table-frame coordinates (m) of the point called `name` in the table of dimensions."""
    x, y = dimensions().all(name)
    return x, y


def inches(metres: float) -> str:
    return f"{metres / INCH:.3f}".lstrip("0").rstrip("0").rstrip(".")
