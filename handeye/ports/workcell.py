"""The devices of a cell as the working phase knows them, and all of their readings as one record."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from msgspec.structs import replace

from handeye.core.pose import Array
from handeye.ports.axes import Axes, Channel
from handeye.ports.camera import TvCamera
from handeye.ports.clock import Clock


class ScrewdriverPort(ABC):
    """The motor of a screwdriver.

    The watchdog of the arm that carries it cuts it, too: it stands still until the program has set the brakes of the
    arm and then a new speed.
    """

    @abstractmethod
    def torque(self) -> float:
        """Torque of the motor by its current, N m, positive when it drives a screw in; the same until time passes."""

    @abstractmethod
    def drive(self, speed: float) -> None:
        """Set the speed of the spindle, rad/s, positive to drive a screw in; raises InvalidInput unless finite."""

    @abstractmethod
    def attract(self, on: bool) -> None:
        """Switch the magnet of the bit, which is on at first."""


class LampPort(ABC):
    """A lamp."""

    @abstractmethod
    def switch(self, lit: bool) -> None:
        """Switch it on or off."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HandReading:
    """Readings of a hand."""

    gap: float  # opening between the finger tips by the hand's potentiometer, m
    touch: tuple[bool, bool]
    """The microswitch inside each finger: (finger on the +y side of the hand frame, finger on the -y side)."""


class HandPort(ABC):
    """Motor and sensors of a hand."""

    @abstractmethod
    def read(self) -> HandReading:
        """Readings of the present moment. Reading twice without letting time pass gives the same values."""

    @abstractmethod
    def drive(self, gap: float, grip: float) -> None:
        """Set the gap (m) to go to and the most force (N) of each finger; raises InvalidInput unless finite."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmReading:
    """Readings of an arm of n joints."""

    q: Array  # joint positions by the potentiometers, shape (n,), rad or m, calibration error included
    qd: Array  # joint rates by the tachometers, shape (n,)
    braked: bool  # brakes set, drives off


class ArmPort(ABC):
    """Motors, brakes and sensors of an arm.

    A watchdog guards it: an arm that gets no new command before the clock has advanced by a servo period has its
    drives cut and its brakes set, and stays so until the program sets the brakes itself. Where the clock advances by
    more than that at once, they are cut from the beginning. The hand is not cut: it keeps hold of what it has.
    """

    @abstractmethod
    def read(self) -> ArmReading:
        """Readings of the present moment. Reading twice without letting time pass gives the same values."""

    @abstractmethod
    def drive(self, torque: Array | None) -> None:
        """Put out joint torques (N m, N) for a servo period, None: brakes; raises InvalidInput unless n finite ones."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensed:
    """All readings at the end of a servo period; of devices that the cell does not have, zero and False."""

    time: float
    q: Array  # as `ArmReading.q`, shape (n,)
    qd: Array  # as `ArmReading.qd`, shape (n,)
    gap: float = 0.0  # as `HandReading.gap`, m
    touch: tuple[bool, bool] = (False, False)  # as `HandReading.touch`
    tool_torque: float = 0.0  # as `ScrewdriverPort.torque`, N m
    braked: bool = False  # as `ArmReading.braked`
    channels: Mapping[Channel, tuple[float, ...]] = field(default_factory=dict)
    """Values of everything else that machines sense."""


def sense_axes(machines: Sequence[Axes], before: Sensed | None = None) -> Sensed:
    """Readings of machines under one clock, their axes one after another; of several, channels are called `left.force`.

    Args:
        before: the last readings, from which rates are derived; without them all axes stand.
    """
    readings = [machine.read() for machine in machines]
    time, q = readings[0].time, np.concatenate([reading.q for reading in readings])
    passed = 0.0 if before is None else time - before.time
    channels = {}
    for machine, reading in zip(machines, readings, strict=True):
        for channel in machine.channels:
            values = tuple(reading.channels[part] for part in channel.parts)
            several = len(machines) > 1
            channels[replace(channel, name=f"{machine.name}.{channel.name}") if several else channel] = values
    rate = np.zeros(len(q)) if before is None or not passed else (q - before.q) / passed
    return Sensed(time=time, q=q, qd=rate, channels=channels)


@dataclass(frozen=True, slots=True, kw_only=True)
class Workcell:
    """An arm with the devices about it, under one clock. A cell with two arms is two of these with the same clock."""

    clock: Clock
    arm: ArmPort
    hand: HandPort | None = None
    screwdriver: ScrewdriverPort | None = None
    lamp: LampPort | None = None
    camera: TvCamera | None = None

    def sense(self) -> Sensed:
        """Read all devices."""
        arm = self.arm.read()
        hand = None if self.hand is None else self.hand.read()
        return Sensed(
            time=self.clock.now,
            q=arm.q,
            qd=arm.qd,
            gap=0.0 if hand is None else hand.gap,
            touch=(False, False) if hand is None else hand.touch,
            tool_torque=0.0 if self.screwdriver is None else self.screwdriver.torque(),
            braked=arm.braked,
        )
