"""Machines by name: arms with axes, as values that tell what they are and how they are put on a bench.

A machine is added by a module that defines an `ArmMachine`, and a line in `MACHINES`.
"""

from collections.abc import Mapping
from importlib import import_module
from typing import Final, cast

from handeye.core.diagnostics import quoted
from handeye.core.errors import InvalidInput
from handeye.machines.arm_machine import ArmMachine, HandlingLimits

__all__ = ["MACHINES", "ArmMachine", "HandlingLimits", "machine"]

MACHINES: Final[Mapping[str, str]] = {"purbrick": "handeye.machines.purbrick:PURBRICK"}
"""Where the machine of each name is defined."""


def machine(name: str) -> ArmMachine:
    """The machine of a name.

    Raises:
        InvalidInput: there is none.
    """
    if name not in MACHINES:
        raise InvalidInput(f"there is no machine {quoted(name)}; there are {', '.join(MACHINES)}")
    module, _, value = MACHINES[name].partition(":")
    return cast(ArmMachine, getattr(import_module(module), value))
