"""Finds machines by name. A machine is an arm with axes. It is a value of type `ArmMachine`, which contains the arm's
specification and the function that puts the arm on a bench.

A system can use an `ArmMachine` directly. Machines that other systems can find by name are listed here, or in
`Entry.machines` of a system.
"""

from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.entries import entries, loaded
from handeye.core.errors import NoSuchName
from handeye.machines.arm_machine import ArmMachine

_OWN: Final = {"purbrick": "handeye.machines.purbrick:PURBRICK"}


def find_machine(name: str) -> ArmMachine:
    """Return the machine called `name`. Raises NoSuchName if there is no such machine."""
    places = {key: place for entry in entries().values() for key, place in entry.machines.items()} | _OWN
    if name not in places:
        raise NoSuchName(f"there is no machine {quoted(name)}; the machines are {', '.join(places)}")
    machine: ArmMachine = loaded(places[name])
    return machine
