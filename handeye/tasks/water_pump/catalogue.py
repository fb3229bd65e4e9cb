"""The catalogue of what can be broken in the pump's world."""

from dataclasses import replace

from handeye.faults import Catalogue
from handeye.tasks.water_pump.device_faults import device_faults
from handeye.tasks.water_pump.noticing import expected
from handeye.tasks.water_pump.part_faults import part_faults


def catalogue(seed: int) -> Catalogue:
    """What can be broken in the world of a seed: devices, then parts."""
    devices, parts = device_faults(), part_faults(seed)
    kinds = (*(fault.kind for fault in devices), *(fault.kind for fault in parts))
    return Catalogue(*(replace(kind, expected=expected(kind.name)) for kind in kinds))
