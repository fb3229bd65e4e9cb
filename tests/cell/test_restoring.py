"""A cell put back into a state goes on as it did from there, whatever it has done since."""

import json
from collections.abc import Callable
from functools import cache

import msgspec
import mujoco
import numpy as np
import pytest
from driving import Drive, tick

from handeye.cell.simulated import SimulatedCell
from handeye.cell.state import CellState
from handeye.core.errors import InvalidInput
from handeye.core.units import JIFFY
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow

PERIODS = 4


@cache
def drawn() -> SimulatedCell:
    """A cell in a drawn world, whose sensors have noise."""
    return build_cell(PumpWorld.sample(3), camera="ray")


def driven(cell: SimulatedCell) -> bytes:
    """All that is sensed while the arm is driven for a while."""
    sensed = [tick(cell.devices, Drive(torque=np.full(6, 0.1))) for _ in range(PERIODS)]
    return b"".join(np.hstack([s.q, s.qd, s.gap, s.tool_torque]).tobytes() for s in sensed)


def released(cell: SimulatedCell) -> bytes:
    """All that is sensed while nobody says anything new to the devices."""
    cell.advance(JIFFY)
    sensed = cell.devices.sense()
    return np.hstack([sensed.q, sensed.qd, sensed.gap, sensed.braked]).tobytes()


def aimed(cell: SimulatedCell) -> bytes:
    """Where the camera really looks after it was aimed, its mount not being exact."""
    camera = cell.devices.camera
    camera.aim(0.1, 0.2)
    camera.aim(0.2, 0.1)
    return np.array(cell.truth.states["camera"].stand).tobytes()


def resting() -> None:
    tick(drawn().devices)


def driving() -> None:
    tick(drawn().devices, Drive(torque=np.full(6, 0.2), gap=0.06), ticks=2)


def cut() -> None:
    """The drives are cut: a period was missed."""
    driving()
    drawn().advance(JIFFY)


@pytest.mark.parametrize("before", [resting, driving, cut])
@pytest.mark.parametrize("goes_on", [driven, released, aimed])
def test_a_cell_that_was_put_back_goes_on_as_it_did(
    before: Callable[[], None], goes_on: Callable[[SimulatedCell], bytes]
) -> None:
    cell = drawn()
    before()
    state = cell.capture()
    cell.restore(state)
    first = goes_on(cell)
    tick(cell.devices, Drive(gap=0.02, tool=3.0), ticks=2)
    cell.restore(state)
    assert goes_on(cell) == first


def test_a_captured_state_is_that_of_the_cell_it_was_put_into() -> None:
    driving()
    state = drawn().capture()
    other = build_cell(PumpWorld.sample(3), camera="ray")
    other.restore(state)
    assert written(other.capture()) == written(state)


def written(state: CellState) -> tuple[object, ...]:
    """Everything in a state, comparable."""
    figures = {name: values.tobytes() for name, values in state.figures.items()}
    return state.physics.tobytes(), figures, json.loads(state.noise), state.mechanisms


@pytest.mark.parametrize("strange", [np.nan, np.inf])
def test_a_state_that_is_not_finite_is_refused_and_changes_nothing(strange: float) -> None:
    cell = drawn()
    state = cell.capture()
    physics = state.physics.copy()
    physics[5] = strange
    with pytest.raises(InvalidInput, match=r"work cell: some saved values are not finite numbers$"):
        cell.restore(msgspec.structs.replace(state, physics=physics))
    assert written(cell.capture()) == written(state)


def test_what_slept_sleeps_again_after_one_step_and_what_moves_does_not() -> None:
    cell, data = drawn(), drawn().truth.data
    cell.restore(cell.capture())
    while data.ntree_awake > 1:  # the arm is not still
        tick(cell.devices, Drive(torque=np.zeros(6)))
    slept = data.tree_asleep >= 0
    data.qvel[cell.truth.model.joint("pin0").dofadr[0]] = 0.2
    cell.restore(cell.capture())
    mujoco.mj_step(cell.truth.model, data)
    pin = cell.truth.model.body_treeid[cell.truth.model.body("pin0").id]
    assert data.tree_asleep[pin] < 0
    slept[pin] = False
    assert (data.tree_asleep[slept] >= 0).all()
    assert slept.sum() >= 10
