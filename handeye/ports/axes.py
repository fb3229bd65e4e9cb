"""Axes whose servos are closed outside the computer, which only names goals and watches channels."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from handeye.core.pose import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class AxisSpec:
    """One axis as its machine's manual describes it."""

    name: str
    kind: Literal["revolute", "prismatic"]
    lower: float
    """rad or m, as `upper`."""
    upper: float
    speed: float
    """Greatest, rad/s or m/s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AxesReading:
    """Readings of a machine of n axes."""

    time: float
    """s on the cell's clock."""
    q: Array
    """Where the axes are, shape (n,), rad or m."""
    channels: Mapping[str, float]
    """Everything else that the machine senses, by name, SI."""


class Axes(ABC):
    """A machine that goes where it is told by itself."""

    @property
    @abstractmethod
    def specs(self) -> tuple[AxisSpec, ...]:
        """Its axes, in order."""

    @property
    @abstractmethod
    def period(self) -> float:
        """s between two goals that its controller takes."""

    @abstractmethod
    def read(self) -> AxesReading:
        """Readings of the present moment. Reading twice without letting time pass gives the same values."""

    @abstractmethod
    def put(self, goal: Array, hand: float) -> None:
        """Name where the axes, shape (n,), rad or m, and the hand (m) are to go from now on.

        Raises:
            InvalidInput: a goal is not a finite number.
        """
