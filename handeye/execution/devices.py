"""The devices that operations need, and whether a cell has them."""

from typing import Final

from handeye.errors import InvalidInput
from handeye.ports.workcell import Workcell
from handeye.program import operations as op
from handeye.program.program import Program

_HAND: Final = (op.Open, op.Close, op.Center)
_CAMERA: Final = (op.Lens, op.Aim, op.Look)


def check_devices(program: Program, cell: Workcell) -> None:
    """See that a program can be carried out by the devices of a cell.

    Raises:
        InvalidInput: a step needs one that is not there.
    """
    there = {
        "hand": (cell.hand is not None, _HAND),
        "screwdriver": (cell.screwdriver is not None, (op.Tool,)),
        "television camera": (cell.camera is not None, _CAMERA),
    }
    for step in program.steps:
        for device, (available, operations) in there.items():
            if isinstance(step.operation, operations) and not available:
                raise InvalidInput(f"line {step.place} needs a {device}, which this cell does not have")
