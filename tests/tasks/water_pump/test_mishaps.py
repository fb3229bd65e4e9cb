"""Things happen to the pump's cell when they are due, once, and the same again from a state that was kept."""

from collections.abc import Iterator

import numpy as np
import pytest

from handeye.cell.simulated import SimulatedCell
from handeye.core.errors import InvalidInput
from handeye.core.pose import Array
from handeye.core.variation import WorldSpec
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.faults.during import LIFTED_M, MOVE_S, PUSH_S, MishapsState, mishap_faults
from handeye.tasks.water_pump.task import WATER_PUMP
from handeye.tasks.water_pump.world.pump_world import PumpWorld

PERIOD = 1 / 60


def cell_with(*names: str) -> SimulatedCell:
    """A cell in which faults set in with stage 2, at their usual size."""
    faults = tuple(WATER_PUMP.faults(WorldSpec(seed=3)).kind(name).usual(2) for name in sorted(names))
    return build_cell(PumpWorld.draw(WorldSpec(seed=3, faults=faults)), camera="ray")


def place(cell: SimulatedCell, part: str) -> Array:
    """Where a part is, m."""
    return np.array(cell.truth.data.body(part).xpos)


def over(cell: SimulatedCell) -> list[bool]:
    """Whether each thing has happened."""
    state = cell.truth.states["mishaps"]
    assert isinstance(state, MishapsState)
    return [each.over for each in state.mishaps]


def ways(cell: SimulatedCell, seconds: float) -> Iterator[Array]:
    """Forces on the hand, period after period."""
    for _ in range(round(seconds / PERIOD)):
        cell.advance(PERIOD)
        yield cell.truth.data.xfrc_applied[cell.arm.last_link, :3].copy()


@pytest.mark.slow
def test_nothing_happens_before_its_stage_and_the_base_is_gone_after_it() -> None:
    cell = cell_with("base.removed")
    before = place(cell, "base")
    cell.begin_stage(1)
    cell.advance(0.5)
    assert np.allclose(place(cell, "base"), before, atol=1e-3)
    cell.begin_stage(3)  # the second was passed over
    cell.advance(0.5)
    assert (place(cell, "base")[2] < -0.2, place(cell, "top")[2] > 0, over(cell)) == (True, True, [True])


@pytest.mark.slow
def test_somebody_moves_the_base_so_far_and_no_farther() -> None:
    cell = cell_with("base.moved.y")
    before = place(cell, "base")
    cell.begin_stage(2)
    cell.advance(MOVE_S + 1.0)
    moved = place(cell, "base") - before
    assert moved[1] == pytest.approx(0.0254, abs=0.002)
    assert abs(moved[0]) < 0.002


@pytest.mark.slow
def test_somebody_pushes_the_hand_for_two_seconds() -> None:
    cell = cell_with("arm.pushed.z")
    assert not any(force.any() for force in ways(cell, 0.5))
    cell.begin_stage(2)
    pushed = sum(force.tolist() == [0.0, 0.0, 40.0] for force in ways(cell, PUSH_S + 1.0))
    assert pushed * PERIOD == pytest.approx(PUSH_S, abs=2 * PERIOD)


@pytest.mark.slow
def test_a_part_is_lost_when_it_has_been_lifted_and_not_before() -> None:
    cell = cell_with("pin.1.dropped")
    cell.begin_stage(2)
    cell.advance(0.5)
    assert over(cell) == [False]
    joint = cell.truth.model.joint("pin0")
    cell.truth.data.qpos[joint.qposadr[0] + 2] += 1.1 * LIFTED_M
    cell.advance(PERIOD)
    assert (over(cell), place(cell, "pin0")[2] < -0.2) == ([True], True)


@pytest.mark.slow
def test_what_happens_happens_again_from_a_state_that_was_kept() -> None:
    cell = cell_with("base.moved.x", "arm.pushed.y", "light.off")
    cell.begin_stage(2)
    cell.advance(0.5)
    kept = cell.capture()
    ends = []
    for _ in range(2):
        cell.restore(kept)
        cell.advance(3.0)
        ends.append(cell.capture())
    assert np.array_equal(ends[0].physics, ends[1].physics)
    assert ends[0].mechanisms == ends[1].mechanisms
    assert not cell.truth.model.light_diffuse.any()
    other = cell_with("base.removed")
    with pytest.raises(InvalidInput, match="it has different faults"):
        other.restore(kept)


def test_the_catalogue_has_all_that_can_happen_by_hand_or_by_chance() -> None:
    assert {fault.name for fault in mishap_faults()} <= WATER_PUMP.faults(WorldSpec(seed=0)).kinds.keys()
