"""The devices that operations need, and whether a cell has them."""

from typing import Final

from handeye.core.errors import Refused
from handeye.ports.workcell import Workcell
from handeye.program.operation import Device
from handeye.program.program import Program

_CALLED: Final[dict[Device, str]] = {"camera": "television camera"}
"""Devices that people call otherwise."""


def check_devices(program: Program, cell: Workcell) -> None:
    """See that a program can be carried out by the devices of a cell.

    Raises:
        InvalidInput: a step needs one that is not there.
    """
    devices = {"hand": cell.hand, "screwdriver": cell.screwdriver, "camera": cell.camera}
    for step in program.steps:
        needed = step.needs
        if needed is not None and devices[needed] is None:
            called = _CALLED.get(needed, needed)
            raise Refused(f"line {step.place} needs a {called}, which this cell does not have")
