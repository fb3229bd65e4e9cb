"""The interface of an arm for TRIG."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from handeye.core.errors import Refused
from handeye.core.record import Vector3
from handeye.systems.trig.language.obstacles import Obstacle
from handeye.systems.trig.language.place import AXES, SIZES, UNITS, Place

Halted = Callable[[], bool]
"""Polled during motion: True to stop the arm."""


class OutOfTravel(Refused):
    """A place beyond the arm's travel."""

    def __init__(self, axis: int, value: float, lower: float, upper: float) -> None:
        told = [f"{number / SIZES[axis]:.4g}" for number in (value, lower, upper)]
        super().__init__(
            f"{AXES[axis]} would be {told[0]} {UNITS[axis]}; the arm goes from {told[1]} to {told[2]}"
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrival:
    """The end of a guarded move; `force` is weighted, N."""

    kind: Literal["reached", "tripped", "halted"]
    force: float = 0.0


class TrigArm(ABC):
    """An arm with a hand."""

    @abstractmethod
    def here(self) -> Place:
        """The commanded place, without the servo's sag."""

    @property
    @abstractmethod
    def closed(self) -> bool:
        """True if the hand is closed, on something or not."""

    @property
    @abstractmethod
    def travel(self) -> tuple[tuple[float, float], ...]:
        """Travel of each axis, m and rad."""

    @abstractmethod
    def go(self, goal: Place, halted: Halted) -> bool:
        """Go to a place; False if halted, where it then is."""

    @abstractmethod
    def feel(self, goal: Place, vector: Vector3, threshold: float, halted: Halted) -> Arrival:
        """Go slowly and straight to a place, until the weighted force on the finger exceeds a threshold (N)."""

    @property
    @abstractmethod
    def met(self) -> float:
        """Greatest force on the finger in the last move, less its initial value, N."""

    @abstractmethod
    def back(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | Obstacle | None:
        """Return to an earlier place under guards; None if it is reached, else the arm stops where it is.

        `met` is the force that the reversed move met, N: half as much again is no obstacle.
        """

    @abstractmethod
    def set_down(self, goal: Place, halted: Halted, met: float = 0.0) -> Literal["halted"] | Obstacle | None:
        """Return to where the held object was taken up, and set it down; as `back`."""

    @abstractmethod
    def hand(self, closed: bool) -> None:
        """Close or open the hand."""

    @property
    @abstractmethod
    def gap(self) -> float:
        """Sensed gap between the fingers, m."""

    def check_travel(self, goal: Place) -> None:
        """Raise OutOfTravel if the arm cannot reach a place."""
        for axis, (value, (lower, upper)) in enumerate(zip(goal, self.travel, strict=True)):
            if not lower - _SLACK <= value <= upper + _SLACK:
                raise OutOfTravel(axis, value, lower, upper)

    def within_travel(self, goal: Place) -> Place:
        """The nearest place within travel, axis by axis."""
        return Place(
            *(min(max(a, lower), upper) for a, (lower, upper) in zip(goal, self.travel, strict=True))
        )


_SLACK = 1e-9  # m or rad, for sums of decimals
