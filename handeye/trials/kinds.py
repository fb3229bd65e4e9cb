"""Kinds of sweeps by name: those of planned programs and their tasks, and those that systems offer."""

from typing import Any, Final

from handeye.core.diagnostics import quoted
from handeye.core.entries import entries, loaded
from handeye.core.errors import BadArgument, NoSuchName
from handeye.trials.sweep import Sweep

_OURS: Final = {
    "assembly": "handeye.trials.plans.trial:ASSEMBLY",
    "dismantling": "handeye.trials.plans.dismantling:DISMANTLING",
    "faults": "handeye.trials.faults:FAULTS",
    "disturbed": "handeye.trials.disturbing:DISTURBED",
    "chaos": "handeye.trials.chaos.trials:CHAOS",
    "insertion": "handeye.trials.insertion:INSERTION",
    "eye": "handeye.trials.eye:EYE",
}


def sweep_of(kind: str) -> Sweep[Any]:
    """The kind of sweep that the folder of a batch says; raises InvalidInput if there is none such here."""
    name = kind.partition(" ")[0]
    places = {name: place for entry in entries().values() for name, place in entry.sweeps.items()} | _OURS
    if name not in places:
        raise NoSuchName(
            f"there are no trials of the kind {quoted(name)} here; there are {', '.join(sorted(places))}"
        )
    found = loaded(places[name])
    if not isinstance(found, Sweep):
        raise BadArgument(f"{places[name]} is {found!r}, which is no Sweep")
    return found
