"""A servo period that has passed, as recorders and views are given it."""

from dataclasses import dataclass

from handeye.core.pose import Array
from handeye.ports.workcell import Sensed
from handeye.touch.guards import ActiveGuard


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ServoPeriod:
    """Readings, torques, felt force and guards of a servo period."""

    sensed: Sensed
    """Readings of all devices at its end."""
    effort: Array
    """Torques put out in it, shape (n,), N m (N if prismatic); zero under the brakes and where servos are closed
    outside the computer."""
    wrench: Array | None = None
    """Force (N) of the hand on the world and moment (N m) about its tool centre point in W, shape (6,), as estimated,
    or the force alone, shape (3,), by a sensor; None: not estimated, or only for the tare."""
    guards: tuple[ActiveGuard, ...] = ()
    """Guards that watch at its end."""
