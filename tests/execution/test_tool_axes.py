"""The Stanford arm as a machine of tool coordinates: set-points a period at a time, no plan, and force felt."""

from math import pi

import numpy as np
import pytest
from fakes import FakeCell

from handeye.arm.ik import solve
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.compiled_arm import CompiledArm
from handeye.core.errors import Refused
from handeye.core.pose import Array, hand
from handeye.execution.drive import ArmDrive
from handeye.execution.friction_measurement import measure_joints
from handeye.execution.state import DriveState
from handeye.execution.tool_axes import ToolAxes
from handeye.ports.workcell import Workcell
from handeye.tasks.stanford_cell.dimensions import PARK
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.pump_world import PumpWorld

SLOW = 0.01  # m/s
ALONG = np.eye(7)


def tool(cell: Workcell) -> ToolAxes:
    return ToolAxes(ArmDrive(cell=cell, arm=STANFORD, state=DriveState.holding(cell.sense(), STANFORD)))


def go(axes: ToolAxes, cell: Workcell, goal: Array, speed: float, limit: float | None = None) -> float:
    """Go to a goal at a speed (m/s), until the force along z (N) exceeds a limit; the greatest that was felt."""
    most, at = 0.0, axes.read().q
    for share in np.linspace(0, 1, max(1, round(np.abs(goal - at)[:3].max() / speed / axes.period)) + 1)[1:]:
        axes.put(at + share * (goal - at))
        cell.clock.advance(axes.period)
        most = max(most, abs(axes.read().channels["force_z"]))
        if limit is not None and most > limit:
            break
    return most


def test_a_tool_goes_no_faster_than_its_axes_and_is_refused_what_it_cannot_reach() -> None:
    cell = FakeCell(np.array(PARK)).devices
    axes = tool(cell)
    here = axes.read().q
    for _ in range(30):
        axes.put(here + 0.2 * ALONG[0])
        cell.clock.advance(axes.period)
    assert axes.read().q[0] - here[0] == pytest.approx(0.1, abs=0.005)
    with pytest.raises(Refused, match=r"^tool does not reach its goal: "):
        go(axes, cell, here - 1.4 * ALONG[2], 0.2)


def test_goals_and_readings_between_which_no_time_passes_are_those_of_one_period() -> None:
    cell, once = FakeCell(np.array(PARK)).devices, FakeCell(np.array(PARK)).devices
    axes, plain = tool(cell), tool(once)
    here = axes.read().q
    for _ in range(10):
        before = axes.read().q
        axes.put(here)
        axes.put(here + 0.2 * ALONG[0])
        assert (axes.read().q == before).all()
        plain.put(here + 0.2 * ALONG[0])
        cell.clock.advance(axes.period)
        once.clock.advance(axes.period)
    assert axes.read().q.tolist() == plain.read().q.tolist()


@pytest.mark.slow
def test_a_guarded_descent_stops_on_the_table_near_its_limit() -> None:
    simulated = build_cell(PumpWorld.nominal(), camera="ray")
    cell = simulated.devices
    state = DriveState.holding(cell.sense(), STANFORD)
    measured = measure_joints(cell, STANFORD, state, arithmetic=CompiledArm)
    state.friction, state.links = measured.friction, measured.links
    drive = ArmDrive(cell=cell, arm=STANFORD, state=state, arithmetic=CompiledArm)
    over = (0.80, 0.75, 0.10, pi / 2, pi / 2, 0.0)
    joints, start = solve(STANFORD, hand(*over), state.q).q, state.q.copy()
    assert joints is not None
    for share in np.linspace(0, 1, 121)[1:]:
        ease = share**3 * (10 - 15 * share + 6 * share**2)
        drive._pass(drive._approach(drive.dynamics(), start + (joints - start) * ease, estimate=False))
    axes = ToolAxes(drive)
    axes.tare()
    above, below = np.array([*over, 0.0]), np.array([*over[:2], -0.05, *over[3:], 0.0])
    assert go(axes, cell, above - 0.03 * ALONG[2], 0.025) < 3.0  # in the air
    felt = go(axes, cell, below, SLOW, limit=6.0)
    assert 6.0 < felt < 7.5
    assert axes.read().q[2] < 0.05
