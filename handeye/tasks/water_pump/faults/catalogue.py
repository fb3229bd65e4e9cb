"""The catalogue of the pump's faults, and those tried by default."""

from typing import Final

from handeye.core.faults import Catalogue
from handeye.tasks.water_pump.faults.before import part_faults
from handeye.tasks.water_pump.faults.devices import device_faults
from handeye.tasks.water_pump.faults.during import mishap_faults

MATRIX: Final = (
    "finger_switch.stuck_closed",
    "finger_switch.minus_y.stuck_open",
    "gap_potentiometer.stuck",
    "gap_potentiometer.off",
    "finger_motor.dead",
    "force.off_zero.z",
    "potentiometer.1.jump",
    "potentiometer.3.stuck",
    "potentiometer.4.drift",
    "tachometer.2.dead",
    "drive.2.weak",
    "brake.2.slips",
    "servo.late",
    "screwdriver.motor.dead",
    "screwdriver.current.dead",
    "screwdriver.missing",
    "magnet.weak",
    "bit.smooth",
    "lamp.dead",
    "picture.dark",
    "picture.frozen",
    "camera.bumped",
    "turret.stuck",
    "light.shadow",
    "light.off",
    "base.missing",
    "base.turned",
    "base.reversed",
    "base.far",
    "base.moved.x",
    "base.removed",
    "pin.1.missing",
    "pin.1.dropped",
    "pin.2.thick",
    "hole.2.blocked",
    "hole.3.blocked",
    "thread.1.scarred",
    "thread.1.stripped",
    "thread.3.crosses",
    "thread.6.full",
    "gasket.missing",
    "gasket.doubled",
    "gasket.off.x",
    "gasket.turned",
    "gasket.dropped",
    "gasket.reversed",
    "top.missing",
    "top.off.y",
    "top.tilted",
    "top.dropped",
    "top.reversed",
    "screw.3.missing",
    "screw.1.burred",
    "screw.2.slotless",
    "rotor.jammed",
    "arm.pushed.y",
)  # faults that `handeye faults` tries by default: one of those alike in joints, pins, screws and holes


def catalogue(seed: int) -> Catalogue:
    """The faults of a seed's world: devices, parts, mishaps."""
    return Catalogue(*device_faults(), *part_faults(seed), *mishap_faults(), matrix=MATRIX)
