"""The interface of an arm for TRIG, and the obstacles that stop the arm while it reverses a step.

A reversal assumes that the table is as the step left it. But a block may have fallen or been taken away after the
step. Therefore every step is reversed with guards, and the first guard that trips ends the reversal.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from handeye.core.errors import Refused
from handeye.core.plain_text import distinct_digits
from handeye.core.record import Record, Vector3
from handeye.core.units import MILLIMETRE
from handeye.systems.trig.language.place import AXES, SIZES, UNITS, Place


class Resistance(Record, frozen=True, kw_only=True, tag="resisted"):
    """The finger met an unexpected force (N)."""

    force: float
    limit: float


class HoldOff(Record, frozen=True, kw_only=True, tag="hold_off"):
    """The gap between the fingers (m) differs from the gap during the step, because the hand holds another object or
    no object.
    """

    gap: float
    kept: float


class LeftBehind(Record, frozen=True, kw_only=True, tag="left_behind"):
    """An axis lags behind its goal. The lag is in m or rad. Axes are numbered from 0, as in AXES."""

    axis: int
    off: float
    limit: float


class MissingContact(Record, frozen=True, kw_only=True, tag="missed"):
    """A guarded move made contact at this place, but the arm now meets no object."""


class MissingSupport(Record, frozen=True, kw_only=True, tag="unsupported"):
    """The support from which the held object was taken up is gone."""


Obstacle = Resistance | HoldOff | LeftBehind | MissingContact | MissingSupport


def told_obstacle(obstacle: Obstacle) -> str:
    match obstacle:
        case Resistance(force=force, limit=limit):
            felt, allowed = distinct_digits((force, limit), 1)
            return f"the finger met a force of {felt} N; the limit while going back is {allowed} N"
        case HoldOff(gap=gap, kept=kept):
            now, then = distinct_digits((gap / MILLIMETRE, kept / MILLIMETRE), 1)
            return f"the fingers are {now} mm apart; on the way forward they were {then} mm apart"
        case LeftBehind(axis=axis, off=off, limit=limit):
            far, allowed = distinct_digits((off / SIZES[axis], limit / SIZES[axis]), 1)
            return f"{AXES[axis]} is {far} {UNITS[axis]} from its commanded place; the limit is {allowed}"
        case MissingContact():
            return "on the way forward the finger met an object here, but now the finger meets nothing"
        case MissingSupport():
            return "the hand had picked up its part from a support here, but now there is no support"


Halted = Callable[[], bool]  # polled during motion: True to stop the arm


class OutOfTravel(Refused):
    """Raised if a place is beyond the arm's travel."""

    def __init__(self, axis: int, value: float, lower: float, upper: float) -> None:
        told = [f"{number / SIZES[axis]:.4g}" for number in (value, lower, upper)]
        super().__init__(
            f"{AXES[axis]} would be {told[0]} {UNITS[axis]}; its range is {told[1]} to {told[2]} {UNITS[axis]}"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrival:
    """How a guarded move ended. `force` is the force (N), weighted by the force vector of the move."""

    kind: Literal["reached", "tripped", "halted"]
    force: float = 0.0


class TrigArm(ABC):
    """An arm with a hand, as TRIG uses it."""

    @abstractmethod
    def here(self) -> Place:
        """Return the commanded place. The true place differs from the commanded place by the sag of the servos."""

    @property
    @abstractmethod
    def closed(self) -> bool:
        """True if the hand is closed, with or without an object in it."""

    @property
    @abstractmethod
    def travel(self) -> tuple[tuple[float, float], ...]:
        """Travel of each axis (m or rad)."""

    @abstractmethod
    def go(self, goal: Place, halted: Halted) -> bool:
        """Go to a place. Returns False if the move was halted; the arm then stays where it stopped."""

    @abstractmethod
    def feel(self, goal: Place, vector: Vector3, threshold: float, halted: Halted) -> Arrival:
        """Go slowly and straight to a place. Stop if the dot product of `vector` and the force on the finger exceeds a
        threshold (N).
        """

    @property
    @abstractmethod
    def met(self) -> float:
        """Greatest change of the force on the finger in the last move (N)."""

    @abstractmethod
    def back(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | Obstacle | None:
        """Return to an earlier place. `met` is the greatest force (N) that the arm met when it moved away from the
        earlier place. The force limit of the return is 1.5 times `met`, or the usual limit of the arm if this limit is
        greater. Returns None if the arm reached the place. If the arm stopped before the place, returns the reason.
        """

    @abstractmethod
    def set_down(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | Obstacle | None:
        """Return to the place where the held object was taken up, and set the object down. The arguments and the
        result are the same as for `back`.
        """

    @abstractmethod
    def hand(self, closed: bool) -> None:
        """Close or open the hand."""

    @property
    @abstractmethod
    def gap(self) -> float:
        """Sensed gap between the fingers (m)."""

    def check_travel(self, goal: Place) -> None:
        """Raise OutOfTravel if the arm cannot reach a place."""
        for axis, (value, (lower, upper)) in enumerate(zip(goal, self.travel, strict=True)):
            if not lower - _SLACK <= value <= upper + _SLACK:
                raise OutOfTravel(axis, value, lower, upper)

    def within_travel(self, goal: Place) -> Place:
        """Return `goal` with each component limited to the travel of its axis."""
        return Place(
            *(min(max(a, lower), upper) for a, (lower, upper) in zip(goal, self.travel, strict=True))
        )


_SLACK = 1e-9  # m or rad, for sums of decimals
