"""The devices of a cell as one value, and all of their readings as one record."""

from dataclasses import dataclass

from handeye.core.pose import Array
from handeye.ports.arm import ArmPort
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
    gap: float
    """As `HandReading.gap`, m."""
    touch: tuple[bool, bool]
    """As `HandReading.touch`."""
    tool_torque: float
    """As `ScrewdriverPort.torque`, N m."""
    braked: bool
    """As `ArmReading.braked`."""


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
