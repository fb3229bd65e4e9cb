"""Teachable: all that TRIG knows of an arm."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from handeye.core.errors import Refused
from handeye.core.record import Vector3
from handeye.systems.trig.language.obstacles import Obstacle
from handeye.systems.trig.language.place import AXES, SIZES, UNITS, Place

Halted = Callable[[], bool]
"""Asked while the arm moves: whether somebody wants it to stop."""


class OutOfTravel(Refused):
    """A place that the arm cannot go to."""

    def __init__(self, axis: int, value: float, lower: float, upper: float) -> None:
        told = [f"{number / SIZES[axis]:.4g}" for number in (value, lower, upper)]
        super().__init__(
            f"{AXES[axis]} would be {told[0]} {UNITS[axis]}; the arm goes from {told[1]} to {told[2]}"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrival:
    """How a guarded move has ended."""

    kind: Literal["reached", "tripped", "halted"]
    force: float = 0.0
    """N, as weighed by the vector, when it ended."""


class Teachable(ABC):
    """An arm with a hand that opens and closes."""

    @abstractmethod
    def here(self) -> Place:
        """Where the arm is, as it was told to be: what a servo sags is not in it."""

    @property
    @abstractmethod
    def closed(self) -> bool:
        """The hand is closed, or closed on something."""

    @property
    @abstractmethod
    def travel(self) -> tuple[tuple[float, float], ...]:
        """Least and greatest value of each axis, m and rad."""

    @abstractmethod
    def go(self, goal: Place, halted: Halted) -> bool:
        """Go to a place. False: it was halted on the way, and stands where it was then.

        Raises:
            OutOfTravel: it cannot go there, and has not moved.
        """

    @abstractmethod
    def feel(self, goal: Place, vector: Vector3, threshold: float, halted: Halted) -> Arrival:
        """Go slowly and straight to a place, until the force on the finger, weighed, exceeds a threshold (N).

        Raises:
            OutOfTravel: it cannot go there, and has not moved.
        """

    @property
    @abstractmethod
    def met(self) -> float:
        """The greatest force that the finger felt in the last move, against its beginning, N."""

    @abstractmethod
    def back(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | Obstacle | None:
        """Go back to a place where the arm was, under guards; None: it is there.

        Whatever has stopped it, it stands still where it is.

        Args:
            met: the force that the move met which is undone, N: half as much again is no obstacle on the way back.

        Raises:
            OutOfTravel: it cannot go there, and has not moved.
        """

    @abstractmethod
    def set_down(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | Obstacle | None:
        """Go back to a place from where the hand has taken up what it holds, and set it down there; as `back`."""

    @abstractmethod
    def hand(self, closed: bool) -> None:
        """Close the hand, or open it."""

    @property
    @abstractmethod
    def gap(self) -> float:
        """How far the fingers are apart, as sensed, m."""

    def check_travel(self, goal: Place) -> None:
        """Raises OutOfTravel if the arm cannot go to a place."""
        for axis, (value, (lower, upper)) in enumerate(zip(goal, self.travel, strict=True)):
            if not lower - _SLACK <= value <= upper + _SLACK:
                raise OutOfTravel(axis, value, lower, upper)

    def within_travel(self, goal: Place) -> Place:
        """The nearest place to a goal that the arm can go to, axis by axis."""
        return Place(
            *(min(max(a, lower), upper) for a, (lower, upper) in zip(goal, self.travel, strict=True))
        )


_SLACK = 1e-9
"""m or rad, for sums of decimals."""
