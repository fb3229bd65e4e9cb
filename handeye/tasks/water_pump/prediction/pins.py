"""The aligning pins: out of their holder, into the base, and back."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.program.motion_operations import Travel
from handeye.tasks.water_pump.prediction.assembly import Assembly
from handeye.tasks.water_pump.prediction.poses import inverses, moved, points
from handeye.tasks.water_pump.prediction.things import mouth, pin_in_holder, pinned, seat_in_holder
from handeye.tasks.water_pump.world.dimensions import base_top, dimensions, pin_seat


@dataclass(frozen=True, slots=True, kw_only=True)
class Pin:
    """A pin by the names that the program gives it."""

    number: int
    taken: str
    put: str
    standing: str
    back: str
    """Positions: it is taken out of its holder, put into the base, taken out of that, and put back."""
    holder: str
    hole: str
    along: str
    """What is saved: where its holder is, where the hand is when it goes in, and where it stands along the fingers."""

    @property
    def positions(self) -> tuple[str, ...]:
        """Its positions, in the order of the work."""
        return self.taken, self.put, self.standing, self.back


PINS: Final = (
    Pin(
        number=1, taken="P1", put="T1", standing="Q1", back="P1UP", holder="C1", hole="E1", along="Y1",
    ),
    Pin(
        number=2, taken="P2", put="T2", standing="Q2", back="P2UP", holder="C2", hole="E2", along="X2",
    ),
)  # fmt: skip


def insert(assembly: Assembly, pin: Pin) -> None:
    """Take a pin, put it into its hole, and feel where that is."""
    d, operation = dimensions(), f"pin {pin.number}"
    height = np.array([0.0, 0.0, assembly.planned(pin.taken)[2, 3] - seat_in_holder()])
    X_WP, hand = pin_in_holder(assembly.worlds, pin.number - 1), assembly.hand(pin.taken)
    off = points(X_WP, height) - hand[:, :3, 3]
    assembly.fits(operation, pin.taken, off, _thick())
    X_TP = inverses(moved(hand, assembly.centre(pin.taken, pin.holder, off))) @ X_WP
    X_TP[:, 1, 3] -= points(X_TP, height)[:, 1]  # the fingers have it in their middle

    hand, home = assembly.hand(pin.put), _hole(assembly, pin)
    catch = d("base.screw_holes.radius") + d("base.screw_holes.chamfer")
    nose = points(hand @ X_TP, np.array([0.0, 0.0, -d("pin.nose_length")]))
    assembly.meets(operation, pin.put, home - nose, catch - _point())
    assembly.saved[pin.hole] = home - points(hand @ X_TP, height)  # upright in its hole
    assembly.centre(pin.put, pin.along, home - hand[:, :3, 3])


def ask_across(assembly: Assembly) -> None:
    """Feel where the second pin stands across the base, too, as the careful program does."""
    if "Q2Y" in assembly.ways:
        assembly.centre("Q2Y", "Y2", _hole(assembly, PINS[1]) - assembly.hand("Q2Y")[:, :3, 3])


def take_out(assembly: Assembly, pin: Pin) -> None:
    """Take a pin out of the base, and put it back."""
    d, operation = dimensions(), f"unpin {pin.number}"
    taken, put = assembly.hand(pin.standing), assembly.hand(pin.back)
    off = _hole(assembly, pin) - taken[:, :3, 3]
    assembly.fits(operation, pin.standing, off, _thick())

    shoulder = base_top() + pin_seat(d("base.screw_holes.chamfer"), d("base.screw_holes.radius"))
    upright = np.broadcast_to(np.eye(4), taken.shape).copy()
    upright[:, :3, 3] = _hole(assembly, pin)
    upright[:, 2, 3] = shoulder
    X_TP = inverses(taken) @ upright
    X_TP[:, 1, 3] -= points(X_TP, np.array([0.0, 0.0, assembly.planned(pin.standing)[2, 3] - shoulder]))[:, 1]
    home = pin_in_holder(assembly.worlds, pin.number - 1)[:, :3, 3]
    nose = points(put @ X_TP, np.array([0.0, 0.0, -d("pin.nose_length")]))
    assembly.meets(
        operation, pin.back, home - nose, d("pin_holder.hole_radius") + d("pin_holder.chamfer") - _point()
    )
    assembly.window(operation, pin.back, Travel, (put @ X_TP)[:, 2, 3] - home[:, 2])


def _hole(assembly: Assembly, pin: Pin) -> Array:
    return mouth(assembly.worlds, pinned()[pin.number - 1])


def _thick() -> float:
    return 2 * dimensions()("pin.body_radius")


def _point() -> float:
    """Radius of the point of a pin, which a chamfer leads, m."""
    return dimensions()("pin.nose_radius") - dimensions()("pin.nose_bevel")
