"""Finds devices of a cell that still carry out a command. Such a command would later move parts that lie correctly
now.
"""

from typing import Final

import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import ArmState
from handeye.cell.hand import HandState, ScrewdriverState, SimulatedScrewdriver
from handeye.cell.truth import Truth
from handeye.tasks.stanford_cell.arm import ARM

_ROUNDING: Final = 1e-9  # m and m/s; rounding errors of a servo at its goal


def commanded(truth: Truth) -> list[str]:
    """Return the names of the devices that are still moving or pushing on a command: arm, hand or screwdriver."""
    driven = {"arm": _arm_driven, "hand": _hand_driven, "screwdriver": _driver_driven}
    return [name for name, left in driven.items() if left(truth)]


def _arm_driven(truth: Truth) -> bool:
    """Return True if the arm has a torque command although its brakes are set, or if the torque command does not hold
    the arm still.

    The check allows for a drive that is too weak by some factor, and for friction that carries a part of the load.
    """
    model, arm = truth.model, truth.states[ARM.removesuffix("/")]
    assert isinstance(arm, ArmState)
    joints = range(1, len(arm.q) + 1)
    torque = truth.data.ctrl[[model.actuator(f"{ARM}j{joint}").id for joint in joints]]
    if arm.braked:
        return bool(torque.any()) or (arm.command is not None and not arm.tripped)
    if arm.command is None:
        return False
    friction = model.dof_frictionloss[[model.joint(f"{ARM}j{joint}").dofadr[0] for joint in joints]]
    return bool((np.abs(torque - arm.command) > friction + np.abs(arm.command) / 2).any())


def _hand_driven(truth: Truth) -> bool:
    """Return True if the fingers are neither at their commanded gap nor blocked on the way to it."""
    hand, model = truth.states[f"{ARM}hand"], STANFORD.hand
    assert isinstance(hand, HandState)
    rate = truth.data.ctrl[truth.model.actuator(f"{ARM}grip").id]
    if hand.command is None:
        return bool(rate)
    to_go = min(max(hand.command[0], 0.0), model.gap_max) - hand.set_point
    ahead = hand.set_point - hand.gap
    held_up = to_go * ahead > 0 and abs(ahead) > model.grasp.give
    return not held_up and max(abs(to_go), abs(rate)) > _ROUNDING


def _driver_driven(truth: Truth) -> bool:
    """Return True if the screwdriver has a speed command, or if its motor turns the spindle or a screw."""
    model, driver = truth.model, truth.states[SimulatedScrewdriver.name]
    assert isinstance(driver, ScrewdriverState)
    spindle, drive = (model.actuator(name).id for name in ("spindle", "drive"))
    coupled = model.actuator_gainprm[drive].any() or model.actuator_biasprm[drive].any()
    return bool(driver.command or truth.data.ctrl[[spindle, drive]].any() or coupled)
