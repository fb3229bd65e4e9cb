"""A cell driven by hand, a servo period at a time: everything that is put out, in one record."""

from dataclasses import dataclass

from handeye.core.pose import Array
from handeye.core.units import JIFFY
from handeye.ports.workcell import Sensed, Workcell


@dataclass(frozen=True, kw_only=True)
class Drive:
    """What is put out for a servo period."""

    torque: Array | None = None
    """None: brakes."""
    gap: float = 0.05
    grip: float = 20.0
    tool: float = 0.0
    lamp: bool = False


BRAKED = Drive()


def tick(cell: Workcell, drive: Drive = BRAKED, ticks: int = 1) -> Sensed:
    """Put something out and let servo periods pass; what is sensed at their end."""
    for _ in range(ticks):
        cell.arm.drive(drive.torque)
        if cell.hand is not None:
            cell.hand.drive(drive.gap, drive.grip)
        if cell.screwdriver is not None:
            cell.screwdriver.drive(drive.tool)
        if cell.lamp is not None:
            cell.lamp.switch(drive.lamp)
        cell.clock.advance(JIFFY)
    return cell.sense()
