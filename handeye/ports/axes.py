"""Defines machines whose servos are outside the computer. The computer sends goals,
reads channels and sets outputs.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from handeye.core.errors import NoSuchName, Refused
from handeye.core.pose import Array
from handeye.core.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class AxisSpec:
    """One axis, as the machine's manual describes it. A hand that opens and closes also counts as an axis."""

    name: str
    kind: Literal["revolute", "prismatic"]
    lower: float  # rad or m, like `upper`
    upper: float
    speed: float  # greatest, rad/s or m/s
    force: float | None = None
    """Greatest force (N) or torque (N m) of the axis's servo, such as the grip of a hand. None if the servo is strong
    enough for any task.
    """
    holds: bool = False  # stays where it is when the power is off, by a brake or a gear that locks itself


class Channel(Record, frozen=True, kw_only=True):
    """A quantity that a device senses, with its unit and number of components."""

    name: str
    unit: str = ""  # SI; empty: a switch or a count
    width: int = 1  # components of its values; three are called x, y and z
    latched: bool = False  # its first value other than zero remains until the channel is cleared

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of the channel's components in readings, for example `range`, `force_x` or `beam_1`."""
        if self.width == 1:
            return (self.name,)
        ends = "xyz" if self.width == len("xyz") else map(str, range(1, self.width + 1))
        return tuple(f"{self.name}_{end}" for end in ends)


@dataclass(frozen=True, slots=True, kw_only=True)
class AxesReading:
    """Readings of a machine with n axes."""

    time: float  # s on the cell's clock
    q: Array  # positions of the axes, shape (n,), rad or m
    channels: Mapping[str, float]  # all other sensed values (SI), by the names in `Channel.parts`


class Axes(ABC):
    """A machine whose servos move its axes to their goals."""

    name: str  # name of the machine, unique among the machines that share its clock

    @property
    @abstractmethod
    def specs(self) -> tuple[AxisSpec, ...]:
        """Specifications of the axes, in order."""

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Quantities that the machine senses in addition to the positions of its axes."""
        return ()

    @property
    @abstractmethod
    def period(self) -> float:
        """The time (s) that must pass before the machine's controller accepts the next goal."""

    @abstractmethod
    def read(self) -> AxesReading:
        """Read the machine. Repeated calls at the same time of the clock return the same values."""

    @abstractmethod
    def put(self, goal: Array) -> None:
        """Set the goals of all axes (rad or m, shape (n,)). The goals hold until the next call."""

    def power(self, on: bool) -> None:
        """Switch the servos on or off. When the servos are switched on, they hold the axes at their present positions.
        Raises Refused if the machine does not allow the switching.
        """
        raise Refused(f"the power of {self.name} cannot be switched")

    def clear(self, channel: str) -> None:
        """Clear a latched channel, so that it follows its sensor again. Raises InvalidInput if no latched
        channel is called `channel`.
        """
        raise NoSuchName(f"{self.name} has no latched channel {channel}")


class Outputs(ABC):
    """Named outputs of a machine."""

    @property
    @abstractmethod
    def names(self) -> tuple[str, ...]:
        """Names of the outputs, in order."""

    @abstractmethod
    def set(self, name: str, value: float) -> None:
        """Set an output. A switch takes 0 or 1; other outputs take a value in SI units. Raises InvalidInput if
        the name is unknown or the value is not finite.
        """
