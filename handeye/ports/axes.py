"""Machines whose servos are closed outside the computer, which names goals, watches channels and sets outputs."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from handeye.core.errors import NoSuchName, Refused
from handeye.core.pose import Array
from handeye.core.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class AxisSpec:
    """One axis as its machine's manual describes it; a hand that opens and closes is one, too."""

    name: str
    kind: Literal["revolute", "prismatic"]
    lower: float  # rad or m, as `upper`
    upper: float
    speed: float  # greatest, rad/s or m/s
    force: float | None = None
    """Greatest force (N) or torque (N m) of its servo, as the grip of a hand; None: more than is ever needed."""
    holds: bool = False  # stays where it is when the power is off, by a brake or a gear that locks itself


class Channel(Record, frozen=True, kw_only=True):
    """A quantity that a device senses."""

    name: str
    unit: str = ""  # SI; empty: a switch or a count
    width: int = 1  # components of its values; three are called x, y and z
    latched: bool = False  # once it differs from zero it stays as it was then, until it is cleared

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of its components, by which readings have them: `range`, `force_x`, `beam_1`."""
        if self.width == 1:
            return (self.name,)
        ends = "xyz" if self.width == len("xyz") else map(str, range(1, self.width + 1))
        return tuple(f"{self.name}_{end}" for end in ends)


@dataclass(frozen=True, slots=True, kw_only=True)
class AxesReading:
    """Readings of a machine of n axes."""

    time: float  # s on the cell's clock
    q: Array  # positions of the axes, shape (n,), rad or m
    channels: Mapping[str, float]  # everything else that the machine senses, SI, by `Channel.parts`


class Axes(ABC):
    """A machine whose axes go to their goals by themselves."""

    name: str  # name of the machine, unlike that of any other under the same clock

    @property
    @abstractmethod
    def specs(self) -> tuple[AxisSpec, ...]:
        """Its axes, in order."""

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Quantities that it senses besides where its axes are."""
        return ()

    @property
    @abstractmethod
    def period(self) -> float:
        """s between two goals that its controller takes."""

    @abstractmethod
    def read(self) -> AxesReading:
        """Readings of the present moment. Reading twice without letting time pass gives the same values."""

    @abstractmethod
    def put(self, goal: Array) -> None:
        """Name where the axes are to go from now on, shape (n,), rad or m."""

    def power(self, on: bool) -> None:
        """Switch its servos on, which hold where they are then, or off; raises Refused if that cannot be done."""
        raise Refused(f"the power of {self.name} cannot be switched")

    def clear(self, channel: str) -> None:
        """Release a latched channel to show its reading again; raises InvalidInput if it has none of that name."""
        raise NoSuchName(f"{self.name} has no latched channel {channel}")


class Outputs(ABC):
    """Outputs of a machine, each with a name."""

    @property
    @abstractmethod
    def names(self) -> tuple[str, ...]:
        """Their names, in order."""

    @abstractmethod
    def set(self, name: str, value: float) -> None:
        """Set an output (a switch: 0 or 1; else SI); raises InvalidInput if unknown or the value is not finite."""
