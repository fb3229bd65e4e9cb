"""Checks that a cell has the devices of a program."""

from typing import Final

from handeye.core.errors import Refused
from handeye.ports.workcell import Workcell
from handeye.program.operation import Device
from handeye.program.program import Program

_CALLED: Final[dict[Device, str]] = {"camera": "television camera"}
"""Names of devices for people."""


def check_devices(program: Program, cell: Workcell) -> None:
    """Raise Refused if a step needs a device that the cell lacks."""
    devices = {"hand": cell.hand, "screwdriver": cell.screwdriver, "camera": cell.camera}
    for step in program.steps:
        needed = step.needs
        if needed is not None and devices[needed] is None:
            called = _CALLED.get(needed, needed)
            raise Refused(f"line {step.place} needs a {called}, which this cell does not have")
