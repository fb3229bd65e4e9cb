"""The catalogue of what can be broken in the pump's world."""

from functools import cache

from handeye.faults import Catalogue
from handeye.tasks.water_pump.device_faults import device_faults


@cache
def catalogue(seed: int) -> Catalogue:
    """What can be broken in the world of a seed."""
    return Catalogue(*(fault.kind for fault in device_faults()))
