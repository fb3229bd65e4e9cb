"""The devices of a cell as one value, and all of their readings as one record."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from msgspec.structs import replace

from handeye.core.pose import Array
from handeye.ports.arm import ArmPort
from handeye.ports.axes import Axes, Channel
from handeye.ports.camera import TvCamera
from handeye.ports.clock import Clock
from handeye.ports.hand import HandPort
from handeye.ports.lamp import LampPort
from handeye.ports.screwdriver import ScrewdriverPort


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensed:
    """All readings at the end of a servo period; of devices that the cell does not have, zero and False."""

    time: float
    q: Array
    """As `ArmReading.q`, shape (n,)."""
    qd: Array
    """As `ArmReading.qd`, shape (n,)."""
    gap: float = 0.0
    """As `HandReading.gap`, m."""
    touch: tuple[bool, bool] = (False, False)
    """As `HandReading.touch`."""
    tool_torque: float = 0.0
    """As `ScrewdriverPort.torque`, N m."""
    braked: bool = False
    """As `ArmReading.braked`."""
    channels: Mapping[Channel, tuple[float, ...]] = field(default_factory=dict)
    """Values of everything else that machines sense."""


def sense_axes(machines: Sequence[Axes], before: Sensed | None = None) -> Sensed:
    """Readings of machines under one clock, their axes one after another; of several, channels are called `left.force`.

    Args:
        before: the last readings, by which rates are told; without them all axes stand.
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
