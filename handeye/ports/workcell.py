"""Defines the interfaces of all devices of a cell, and a record of all their readings."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from msgspec import field
from msgspec.structs import replace

from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.ports.axes import Axes, Channel
from handeye.ports.camera import TvCamera
from handeye.ports.clock import Clock


class ScrewdriverPort(ABC):
    """The motor of a screwdriver.

    The watchdog of the arm that carries the screwdriver also stops the screwdriver's motor. The motor starts
    again only when the program has set the brakes of the arm, and has then set a new speed.
    """

    @abstractmethod
    def torque(self) -> float:
        """Return the torque of the motor (N m), estimated from its current. The torque is positive if the motor drives
        a screw in. The value does not change until time passes.
        """

    @abstractmethod
    def drive(self, speed: float) -> None:
        """Set the speed of the spindle (rad/s). A positive speed drives a screw in. Raises InvalidInput if the
        speed is not finite.
        """

    @abstractmethod
    def attract(self, on: bool) -> None:
        """Switch the magnet of the bit on or off. At the beginning the magnet is on."""


class LampPort(ABC):
    """The lamp of a cell."""

    @abstractmethod
    def switch(self, lit: bool) -> None:
        """Switch the lamp on or off."""


class HandReading(Record, frozen=True, kw_only=True):
    """Readings of a hand."""

    gap: float  # opening between the finger tips by the hand's potentiometer, m
    touch: tuple[bool, bool]
    """State of the microswitch inside each finger: first the switch of the finger on the +y side of the hand frame,
    then the switch of the finger on the -y side.
    """


class HandPort(ABC):
    """The motor and the sensors of a hand."""

    @abstractmethod
    def read(self) -> HandReading:
        """Read the hand. Until time passes, further readings give the same values."""

    @abstractmethod
    def drive(self, gap: float, grip: float) -> None:
        """Set the gap (m) that the fingers should reach, and the greatest force of each finger (N).
        Raises InvalidInput unless both values are finite.
        """


class ArmReading(Record, frozen=True, kw_only=True):
    """Readings of an arm with n joints."""

    q: Array  # joint positions by the potentiometers, shape (n,), rad or m, calibration error included
    qd: Array  # joint rates by the tachometers, shape (n,)
    braked: bool  # brakes set, drives off


class ArmPort(ABC):
    """The motors, brakes and sensors of an arm.

    A watchdog guards the arm. If no new command arrives before the clock has advanced by a servo period, the watchdog
    switches the drives off and sets the brakes. The drives stay off until the program has set the brakes itself. If the
    clock advances by more than a servo period at once, the drives are off for the whole of that time. The watchdog
    does not switch off the hand, which keeps its grip.
    """

    @abstractmethod
    def read(self) -> ArmReading:
        """Read the arm. Until time passes, further readings give the same values."""

    @abstractmethod
    def drive(self, torque: Array | None) -> None:
        """Apply joint torques (N m, or N for prismatic joints; shape (n,)) for a servo period. If `torque` is None,
        set the brakes instead. Raises InvalidInput unless there are n finite torques.
        """


class Sensed(Record, frozen=True, kw_only=True):
    """All readings at the end of a servo period. Readings of devices that the cell does not have are zero or
    False."""

    time: float
    q: Array  # as `ArmReading.q`, shape (n,)
    qd: Array  # as `ArmReading.qd`, shape (n,)
    gap: float = 0.0  # as `HandReading.gap`, m
    touch: tuple[bool, bool] = (False, False)  # as `HandReading.touch`
    tool_torque: float = 0.0  # as `ScrewdriverPort.torque`, N m
    braked: bool = False  # as `ArmReading.braked`
    channels: Mapping[Channel, tuple[float, ...]] = field(default_factory=dict)
    """Values of all sensed quantities that have no field above."""


def sense_axes(machines: Sequence[Axes], before: Sensed | None = None) -> Sensed:
    """Read machines that share a clock, and list their axes one after another. If there are several machines,
    the name of a channel begins with the machine's name, as in `left.force`.

    Args:
        before: the previous readings, from which velocities are computed. Without previous readings, all velocities
            are zero.
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
    """An arm with the devices around it, and a clock. A cell with two arms consists of two workcells that share
    a clock.
    """

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
