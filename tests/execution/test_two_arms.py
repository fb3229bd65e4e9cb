"""Two arms under one clock: each has a servo loop of its own, and one clock lets time pass for both."""

from functools import cache

import mujoco
import numpy as np
import pytest
from fakes import FakeArm, FakeClock

from handeye.arm.kinematics import forward
from handeye.arm.line import straight
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import SimulatedArm
from handeye.cell.simulated import SimulatedCell
from handeye.core.pose import Array
from handeye.core.resources import scenes
from handeye.core.units import INCH, JIFFY
from handeye.execution.scheduler import run
from handeye.execution.servo_loop import REACHED, ServoLoop
from handeye.execution.state import DriveState
from handeye.ports.clock import Clock
from handeye.ports.workcell import ArmPort, Workcell
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.world.pump_world import PumpWorld

SIDES = ("left/", "right/")


def simulated() -> tuple[Clock, list[ArmPort]]:
    """Two arms in one physics, three metres apart."""
    spec = mujoco.MjSpec()
    spec.option.timestep = JIFFY / 16
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    for number, side in enumerate(SIDES):
        arm = mujoco.MjSpec.from_file(str(scenes() / "stanford_arm" / "stanford.xml"))
        spec.attach(arm, frame=spec.worldbody.add_frame(pos=[0.0, 3.0 * number, 0.0]), prefix=side)
    model = spec.compile()
    data, world = mujoco.MjData(model), PumpWorld.nominal()
    noise = world.generator("sensors")
    left, right = (
        SimulatedArm(model, data, side, arm=STANFORD, posture=PARK, errors=world.arm, noise=noise)
        for side in SIDES
    )
    return SimulatedCell(model, data, arm=left, mechanisms=(right,), noise=noise), [left, right]


def fake() -> tuple[Clock, list[ArmPort]]:
    arms = [FakeArm(PARK), FakeArm(PARK)]
    return FakeClock(*arms), list(arms)


CELLS = {"simulated": simulated, "fake": fake}


def loop(cell: Workcell) -> ServoLoop:
    return ServoLoop(cell=cell, arm=STANFORD, state=DriveState.holding(cell.sense(), STANFORD))


@cache
def moved(cell: str) -> tuple[list[ServoLoop], list[object], list[Array]]:
    """The left arm went an inch up while the right one held where it was; the loops, how they ended, the way."""
    clock, arms = CELLS[cell]()
    left, right = (loop(Workcell(clock=clock, arm=arm)) for arm in arms)
    samples = straight(STANFORD, left.state.q, np.array([0.0, 0.0, INCH]), INCH)
    before = [forward(STANFORD, side.sensed.q)[:3, 3] for side in (left, right)]
    ended = run(clock, [left.following(samples), right.holding(len(samples) + 20)])
    ways = [side.hand()[:3, 3] - p for side, p in zip((left, right), before, strict=True)]
    return [left, right], ended, ways


@pytest.mark.parametrize("cell", CELLS)
def test_one_arm_moves_while_the_other_holds(cell: str) -> None:
    _, (reached, _), (left, right) = moved(cell)
    assert reached == REACHED
    assert left / INCH == pytest.approx([0, 0, 1], abs=0.02)
    assert right / INCH == pytest.approx([0, 0, 0], abs=0.02)


@pytest.mark.parametrize("cell", CELLS)
def test_both_arms_are_at_the_same_time_when_they_move_together(cell: str) -> None:
    (left, right), _, _ = moved(cell)
    assert right.cell.clock is left.cell.clock
    assert 0 < left.sensed.time == right.sensed.time == right.cell.clock.now


@pytest.mark.parametrize("cell", CELLS)
def test_an_arm_whose_motion_is_over_is_braked_while_the_other_goes_on(cell: str) -> None:
    (left, right), _, _ = moved(cell)
    assert (left.cell.arm.read().braked, right.cell.arm.read().braked) == (True, False)
