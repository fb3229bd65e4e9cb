"""Fingers that are kicked in free air come to rest as in fine steps of physics, although the steps are long there."""

import numpy as np
import pytest
from driving import Drive, tick
from released_arm import arm_alone

from handeye.cell.physics_stepper import PhysicsStepper
from handeye.core.pose import Array
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.water_pump.world.pump_world import PumpWorld

GAP = 0.04  # m
PERIODS = 6
KICKS = pytest.mark.parametrize(("grip", "kick"), [(20.0, 0.1), (40.0, 0.2), (80.0, 0.4)])
"""Forces that the motor exerts at most (N), and speeds of the kicked fingers (m/s)."""
SWING = 0.09  # m/s: with 20 N, the motor reverses a finger of this speed in one long step; with more, a faster one


def kicked(grip: float, kick: float) -> tuple[Array, float]:
    """Kick both fingers outwards while the arm is braked, in the nominal world.

    Returns:
        the gap (m) after each of some servo periods, shape (n,), and the speed of a finger after the last one (m/s)
    """
    cell, holding, gaps = arm_alone(PumpWorld.nominal()), Drive(gap=GAP, grip=grip), []
    fingers = [cell.truth.data.joint(f"{ARM}finger_{side}") for side in "ab"]
    tick(cell.devices, holding, 60)
    for finger in fingers:
        finger.qvel = kick
    for _ in range(PERIODS):
        tick(cell.devices, holding)
        gaps.append(sum(float(finger.qpos[0]) for finger in fingers))
    return np.array(gaps), abs(float(fingers[0].qvel[0]))


@pytest.mark.slow
@KICKS
def test_kicked_fingers_move_as_in_fine_steps(
    grip: float, kick: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    gaps, _ = kicked(grip, kick)
    monkeypatch.setattr(PhysicsStepper, "_overspeed", lambda _: True)  # all steps are fine
    fine, _ = kicked(grip, kick)
    assert fine[0] > GAP + 1e-4
    assert gaps == pytest.approx(fine, abs=2e-5)


@KICKS
def test_in_long_steps_alone_they_swing_for_ever(
    grip: float, kick: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(PhysicsStepper, "_overspeed", lambda _: False)
    assert kicked(grip, kick)[1] > SWING


@KICKS
def test_kicked_fingers_come_to_rest(grip: float, kick: float) -> None:
    assert kicked(grip, kick)[1] < 0.01
