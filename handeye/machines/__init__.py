"""Finds machines by name: arms with axes, as values with their specification and the function that puts them on a
bench.

A machine is a value of type `ArmMachine`, which a system can use directly. Machines that others can find by name
are listed here, or in `Entry.machines` of a system.
"""

from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.entries import entries, loaded
from handeye.core.errors import NoSuchName
from handeye.machines.arm_machine import ArmMachine

_OWN: Final = {"purbrick": "handeye.machines.purbrick:PURBRICK"}


def find_machine(name: str) -> ArmMachine:
    """The machine with a name; raises NoSuchName if there is none."""
    places = {key: place for entry in entries().values() for key, place in entry.machines.items()} | _OWN
    if name not in places:
        raise NoSuchName(f"there is no machine {quoted(name)}; there are {', '.join(places)}")
    machine: ArmMachine = loaded(places[name])
    return machine
