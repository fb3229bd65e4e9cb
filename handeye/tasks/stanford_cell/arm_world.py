"""The errors of the arm and the hand in one world. A cell is built with these errors."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from handeye.cell.device_errors import ArmBuild, ArmErrors, HandErrors
from handeye.core.pose import Array
from handeye.core.units import UNITS
from handeye.core.variation import World
from handeye.tasks.stanford_cell.arm_variation import ARM_CENTRE, ARM_PERIOD, JOINT_UNITS


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmWorld:
    """One world of a cell with the Stanford arm, with the errors drawn for it."""

    drawn: World
    arm: ArmErrors
    arm_build: ArmBuild
    hand: HandErrors
    lamp: tuple[float, float, float]  # error of the lamp's place on the hand, in T, m
    friction: dict[str, float]
    """Factors on the coefficients of friction, by kind of shape; `pad` is the kind of the fingers."""

    def generator(self, stream: str) -> np.random.Generator:
        """Return a random number generator for noise in this world. Generators of different streams are
        independent."""
        return self.drawn.generator(stream)


def arm_values(world: World, rubbing: Sequence[str]) -> dict[str, Any]:
    """Return a dictionary from the names of an `ArmWorld`'s fields to their values in a world. `rubbing` names the
    kinds of shapes whose friction varies.
    """
    return {
        "drawn": world,
        "arm": _arm(world),
        "arm_build": _arm_build(world),
        "hand": _hand(world),
        "lamp": (world["hand.lamp.x"], world["hand.lamp.y"], world["hand.lamp.z"]),
        "friction": {name: 1 + world[f"friction.{name}"] for name in rubbing},
    }


_OF_JOINTS: Final = (
    "offset", "scale", "wave", "pot_noise", "pot_step", "tachometer_noise", "tachometer_step", "torque_step"
)  # fmt: skip


def _arm(world: World) -> ArmErrors:
    size = np.array([UNITS[unit].size for unit in JOINT_UNITS])
    return ArmErrors(
        **{name: _joints(world, name) for name in _OF_JOINTS},
        period=np.array(ARM_PERIOD) * size,
        phase=_joints(world, "wave_phase"),
        centre=np.array(ARM_CENTRE) * size,
        drive_gain=1 + _joints(world, "drive_gain"),
    )


def _arm_build(world: World) -> ArmBuild:
    return ArmBuild(
        **{name: 1 + _joints(world, name) for name in ("link_mass", "mass_centre", "armature", "damping")},
        friction=_joints(world, "friction"),
        hand_length=world["arm.hand_length"],
    )


def _joints(world: World, name: str) -> Array:
    """Return the values of a quantity for all joints, shape (6,)."""
    return np.array(world.numbered(f"arm.{name}"))


def _hand(world: World) -> HandErrors:
    return HandErrors(
        **{name: world[f"hand.{name}"] for name in ("gap_offset", "gap_scale", "gap_noise", "gap_step")},
        switch_force=(world["hand.switch_force.plus_y"], world["hand.switch_force.minus_y"]),
        torque_noise=world.values.get("screwdriver.torque_noise", 0.0),
    )
