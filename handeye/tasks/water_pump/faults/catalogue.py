"""The catalogue of the pump's faults, and the faults that are tried by default."""

from typing import Final

from handeye.core.faults import Catalogue
from handeye.core.variation import WorldSpec
from handeye.tasks.water_pump.faults.before import part_faults
from handeye.tasks.water_pump.faults.devices import device_faults
from handeye.tasks.water_pump.faults.during import mishap_faults
from handeye.tasks.water_pump.world.variation import screws

_TRIED: Final = {
    "finger_switch": ("stuck_closed", "minus_y.stuck_open", "swapped"),
    "gap_potentiometer": ("stuck", "off", "factor"),
    "finger_motor": ("dead",),
    "force": ("off_zero.z",),
    "potentiometer": ("1.jump", "3.stuck", "4.drift"),
    "tachometer": ("2.dead",),
    "drive": ("2.weak",),
    "drives": ("factor",),
    "brake": ("2.slips",),
    "servo": ("late",),
    "screwdriver": ("motor.dead", "current.dead", "current.factor", "missing"),
    "magnet": ("weak",),
    "bit": ("smooth",),
    "lamp": ("dead",),
    "picture": ("dark", "frozen"),
    "camera": ("bumped",),
    "turret": ("stuck",),
    "light": ("shadow", "off"),
    "base": ("missing", "turned", "reversed", "far", "moved.x", "removed"),
    "pin": ("1.missing", "1.dropped", "2.thick", "1.removed"),
    "hole": ("2.blocked", "3.blocked"),
    "thread": ("1.scarred", "1.stripped", "3.crosses", "6.full"),
    "gasket": ("missing", "doubled", "off.x", "turned", "dropped", "reversed", "torn", "removed"),
    "top": ("missing", "off.y", "tilted", "dropped", "reversed", "removed"),
    "screw": ("3.missing", "1.burred", "2.slotless", "2.loose", "4.loosened", "5.removed"),
    "dispenser": ("moved.y",),
    "top_stand": ("moved.y",),
    "rotor": ("jammed", "stops", "turned", "lifted"),
    "driver": ("fallen", "raised"),
    "arm": ("pushed.y",),
}  # by what is broken; of several similar joints, pins, screws or holes, only one is tried
MATRIX: Final = tuple(f"{broken}.{how}" for broken, hows in _TRIED.items() for how in hows)


def catalogue(world: WorldSpec) -> Catalogue:
    """Return the faults that are possible in a world: faults of devices, faults of parts, and mishaps."""
    return Catalogue(*device_faults(), *part_faults(screws(world)), *mishap_faults(), matrix=MATRIX)
