"""Machines by name: arms with axes, as values that tell what they are and how they are put on a bench.

A machine is added by a module that defines an `ArmMachine`, and a place in `MACHINES`.
"""

from collections.abc import Mapping
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName
from handeye.machines.arm_machine import ArmMachine
from handeye.machines.purbrick import PURBRICK

MACHINES: Final[Mapping[str, ArmMachine]] = {machine.name: machine for machine in (PURBRICK,)}


def find_machine(name: str) -> ArmMachine:
    """The machine of a name; raises NoSuchName if there is none."""
    if name not in MACHINES:
        raise NoSuchName(f"there is no machine {quoted(name)}; there are {', '.join(MACHINES)}")
    return MACHINES[name]
