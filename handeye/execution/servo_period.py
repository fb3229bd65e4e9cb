"""What is known of a servo period when it has passed: what those who look on are told."""

from dataclasses import dataclass

from handeye.core.pose import Array
from handeye.ports.workcell import Sensed
from handeye.touch.guards import ActiveGuard


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ServoPeriod:
    """A servo period as the program knows it."""

    sensed: Sensed
    """Readings of all devices at its end."""
    effort: Array
    """Torques put out in it, shape (n,), N m and (prismatic joints) N; zero under the brakes, and where servos are
    closed outside the computer."""
    wrench: Array | None = None
    """Force (N) of the hand on the world, and moment (N m) about its tool centre point, world axes, shape (6,), as
    the program estimates them; None: it does not, or only for the tare. Shape (3,): the force alone, by a sensor."""
    guards: tuple[ActiveGuard, ...] = ()
    """Guards that watch at its end."""
