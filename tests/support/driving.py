"""Drives a cell directly, one servo period at a time, with all commands in one record."""

from dataclasses import dataclass

from handeye.core.pose import Array
from handeye.core.units import JIFFY
from handeye.ports.workcell import Sensed, Workcell


@dataclass(frozen=True, kw_only=True)
class Drive:
    """All commands for a servo period."""

    torque: Array | None = None
    """None: brakes."""
    gap: float = 0.05
    grip: float = 20.0
    tool: float = 0.0
    lamp: bool = False


BRAKED = Drive()


def tick(cell: Workcell, drive: Drive = BRAKED, ticks: int = 1) -> Sensed:
    """Give commands, and let servo periods pass. Returns what is sensed at the end."""
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
