"""The interfaces of all devices of a cell, and all their readings as one record."""

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

    The watchdog of the arm that carries the screwdriver also stops its motor, until the program has set the brakes
    of the arm and then a new speed.
    """

    @abstractmethod
    def torque(self) -> float:
        """Torque of the motor, estimated from its current, N m, positive when it drives a screw in; constant until
        time passes.
        """

    @abstractmethod
    def drive(self, speed: float) -> None:
        """Set the speed of the spindle, rad/s, positive to drive a screw in; raises InvalidInput if the speed is
        not finite.
        """

    @abstractmethod
    def attract(self, on: bool) -> None:
        """Switch the magnet of the bit on or off; it is on at the beginning."""


class LampPort(ABC):
    """A lamp."""

    @abstractmethod
    def switch(self, lit: bool) -> None:
        """Switch the lamp on or off."""


class HandReading(Record, frozen=True, kw_only=True):
    """Readings of a hand."""

    gap: float  # opening between the finger tips by the hand's potentiometer, m
    touch: tuple[bool, bool]
    """State of the microswitch inside each finger: finger on the +y side of the hand frame, finger on the -y side."""


class HandPort(ABC):
    """Motor and sensors of a hand."""

    @abstractmethod
    def read(self) -> HandReading:
        """Read the hand now. Reading twice without letting time pass gives the same values."""

    @abstractmethod
    def drive(self, gap: float, grip: float) -> None:
        """Set the goal of the gap (m) and the greatest force (N) of each finger; raises InvalidInput unless both
        are finite.
        """


class ArmReading(Record, frozen=True, kw_only=True):
    """Readings of an arm with n joints."""

    q: Array  # joint positions by the potentiometers, shape (n,), rad or m, calibration error included
    qd: Array  # joint rates by the tachometers, shape (n,)
    braked: bool  # brakes set, drives off


class ArmPort(ABC):
    """Motors, brakes and sensors of an arm.

    A watchdog guards the arm: if it gets no new command before the clock has advanced by a servo period, its drives
    are switched off and its brakes set, until the program sets the brakes itself. If the clock advances by more
    than a servo period at once, the drives are off from the beginning. The hand is not switched off: it keeps its
    grip.
    """

    @abstractmethod
    def read(self) -> ArmReading:
        """Read the arm now. Reading twice without letting time pass gives the same values."""

    @abstractmethod
    def drive(self, torque: Array | None) -> None:
        """Apply joint torques (n,), N m and N, for a servo period, or with None set the brakes; raises InvalidInput
        unless there are n finite torques.
        """


class Sensed(Record, frozen=True, kw_only=True):
    """All readings at the end of a servo period; zero and False for devices that the cell does not have."""

    time: float
    q: Array  # as `ArmReading.q`, shape (n,)
    qd: Array  # as `ArmReading.qd`, shape (n,)
    gap: float = 0.0  # as `HandReading.gap`, m
    touch: tuple[bool, bool] = (False, False)  # as `HandReading.touch`
    tool_torque: float = 0.0  # as `ScrewdriverPort.torque`, N m
    braked: bool = False  # as `ArmReading.braked`
    channels: Mapping[Channel, tuple[float, ...]] = field(default_factory=dict)
    """Values of all other quantities that the machines sense."""


def sense_axes(machines: Sequence[Axes], before: Sensed | None = None) -> Sensed:
    """Readings of machines under one clock, with their axes one after another. With several machines, the names of
    channels begin with the machine's name, as in `left.force`.

    Args:
        before: the previous readings, from which rates are computed; without them all rates are zero.
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
    """An arm with the devices around it, under one clock. A cell with two arms consists of two workcells with the
    same clock.
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
