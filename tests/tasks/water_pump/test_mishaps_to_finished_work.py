"""What is finished comes undone as its fault says: screws work loose or fall out, the rotor stops, a tool is gone."""

import math

import mujoco
import numpy as np
import pytest
from finished import stacked, threads_of, tighten

from handeye.cell.simulated import SimulatedCell
from handeye.core.variation import WorldSpec
from handeye.judge.measured import SettledState
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.faults.during import due
from handeye.tasks.water_pump.faults.finished import LATER_S
from handeye.tasks.water_pump.faults.mishap import MishapState, Scene
from handeye.tasks.water_pump.referee.measure import head_force, head_gap
from handeye.tasks.water_pump.task import WATER_PUMP
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

HOLE = 2
PUSH_NM = 0.2  # four times the friction of the rotor


def screwed() -> SimulatedCell:
    """A pump with one screw, which holds."""
    cell = stacked()
    tighten(cell, HOLE)
    cell.advance(0.2)
    return cell


def cell_with(name: str) -> SimulatedCell:
    """A cell in which a fault of usual size has set in."""
    fault = WATER_PUMP.faults(WorldSpec(seed=3)).kind(name).usual(2)
    cell = build_cell(PumpWorld.draw(WorldSpec(seed=3, faults=(fault,))), camera="ray")
    cell.begin_stage(2)
    cell.advance(0.1)
    return cell


def turned(cell: SimulatedCell, torque: float) -> float:
    """How far a torque (N m) turns the rotor within half a second, deg."""
    model, data = cell.truth.copy()
    adr, dof = model.joint("rotor").qposadr[0], model.joint("rotor").dofadr[0]
    before = data.qpos[adr]
    data.qfrc_applied[dof] = torque
    for _ in range(round(0.5 / model.opt.timestep)):
        mujoco.mj_step(model, data)
    return math.degrees(data.qpos[adr] - before)


def test_a_loose_screw_stands_up_by_its_turns_and_clamps_nothing() -> None:
    cell = screwed()
    assert head_force(SettledState(cell.truth), HOLE) > 40
    there = float(cell.truth.data.joint(f"thread_slide{HOLE}").qpos[0])
    assert threads_of(cell).loosen(HOLE, 0.25)
    after = SettledState(cell.truth, 0.1)
    risen = float(after.data.joint(f"thread_slide{HOLE}").qpos[0]) - there
    assert risen == pytest.approx(0.25 * dimensions()("screw.pitch"), abs=2e-5)
    assert head_gap(after, HOLE) > 1e-4  # less than it has risen by: what it clamped springs up
    assert (head_force(after, HOLE), threads_of(cell).holes[HOLE].clamp) == (0.0, 0.0)


def test_a_screw_that_is_turned_out_leaves_its_hole_and_one_in_no_thread_stays_as_it_is() -> None:
    cell = screwed()
    assert threads_of(cell).loosen(HOLE)
    assert threads_of(cell).holes[HOLE].screw is None
    assert not threads_of(cell).loosen(HOLE, 0.25)


def test_a_person_loosens_a_screw_some_time_after_the_last_stage_began() -> None:
    cell = screwed()
    ((_, mishap),) = due((WATER_PUMP.faults(WorldSpec(seed=3)).kind(f"screw.{HOLE + 1}.loosened").usual(12),))
    scene = Scene(cell.truth.model, cell.truth.data, threads_of(cell))
    assert not mishap.act(scene, MishapState(seconds=LATER_S - 0.1))
    assert threads_of(cell).holes[HOLE].clamp > 40
    assert mishap.act(scene, MishapState(seconds=LATER_S))
    assert head_gap(SettledState(cell.truth, 0.1), HOLE) > dimensions()("screw.pitch")


def test_a_rotor_meets_its_stop_on_one_side_and_from_a_state_that_was_kept() -> None:
    kept, cell = cell_with("rotor.stops").capture(), cell_with("rotor.stops")
    cell.restore(kept)
    assert turned(cell, PUSH_NM) == pytest.approx(75.0, abs=2.0)
    assert turned(cell, -PUSH_NM) < -180.0


def rubs(cell: SimulatedCell) -> float:
    """Friction of the rotor, N m."""
    model = cell.truth.model
    return float(model.dof_frictionloss[model.joint("rotor").dofadr[0]])


def test_a_jammed_rotor_rubs_from_its_stage_on_and_not_before() -> None:
    fault = WATER_PUMP.faults(WorldSpec(seed=3)).kind("rotor.jammed").usual(2)
    cell = build_cell(PumpWorld.draw(WorldSpec(seed=3, faults=(fault,))), camera="ray")
    cell.begin_stage(1)
    cell.advance(0.1)
    assert rubs(cell) < PUSH_NM
    assert rubs(cell_with("rotor.jammed")) == 20.0


def test_a_jammed_rotor_turns_neither_way() -> None:
    assert np.abs([turned(cell_with("rotor.jammed"), torque) for torque in (PUSH_NM, -PUSH_NM)]).max() < 3.0


@pytest.mark.parametrize(
    ("fault", "part"),
    [
        ("driver.fallen", "driver"),
        ("pin.2.removed", "pin1"),
        ("gasket.removed", "gasket"),
        ("top.removed", "top"),
    ],
)
def test_what_is_taken_from_its_place_lies_on_the_tray(fault: str, part: str) -> None:
    assert cell_with(fault).truth.data.body(part).xpos[2] < -0.2


@pytest.mark.parametrize(
    ("fault", "body", "height"), [("rotor.lifted", "rotor", 0.004), ("driver.raised", "driver", 0.006)]
)
def test_what_has_come_out_of_its_place_stays_there_and_from_a_state_that_was_kept(
    fault: str, body: str, height: float
) -> None:
    sound = build_cell(PumpWorld.draw(WorldSpec(seed=3)), camera="ray")
    kept, cell = cell_with(fault).capture(), cell_with(fault)
    cell.restore(kept)
    for each in (sound, cell):
        each.advance(5.0)
    risen = cell.truth.data.body(body).xpos[2] - sound.truth.data.body(body).xpos[2]
    assert risen == pytest.approx(height, abs=2e-4)
