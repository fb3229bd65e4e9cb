"""A tape of what a cell does to its simulator, and the physics alone that comes of playing it."""

from itertools import count

import mujoco
import pytest
from driving import BRAKED, Drive, tick

from benchmarks import tape
from benchmarks.bare_physics import Bare, play
from benchmarks.tape import Tape
from handeye.cell.physics_stepper import asleep
from handeye.cell.simulated import SimulatedCell
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = pytest.mark.slow
OPENING = Drive(gap=0.08)
TO_SLEEP = 60
"""Servo periods after which all has stood still for long enough."""


@pytest.fixture
def cell() -> SimulatedCell:
    return build_cell(PumpWorld.nominal(), camera="ray")


def played(cell: SimulatedCell, *drives: tuple[Drive, int]) -> Bare:
    """The physics alone of drives, each for some servo periods; the state is put back behind each."""
    tape = Tape(cell)
    with tape.recording():
        for drive, periods in drives:
            tick(cell.devices, drive, periods)
            cell.restore(cell.capture())
    ticks = count()
    return play(tape, lambda: float(next(ticks)))


def test_the_physics_alone_ends_in_the_same_states(cell: SimulatedCell) -> None:
    found = played(cell, (BRAKED, 3), (OPENING, 5))
    # After each restoring, parts touch until they sleep: one period of middle steps. Then nothing touches. The fingers
    # shut at first, and in the second period they are too fast for long steps: two are undone, and 16 short ones made.
    steps = (8 + (2 + 16) + 4) + (8 + 4 * 4)
    assert found == Bare(seconds=3.0, physics_steps=steps, stretches=3, same=3, apart_s=None)


def test_time_that_passes_in_sleep_is_on_tape_and_takes_no_step(cell: SimulatedCell) -> None:
    tick(cell.devices, BRAKED, TO_SLEEP)
    assert asleep(cell.truth.data)
    found = played(cell, (BRAKED, TO_SLEEP))
    assert found.same == found.stretches
    assert found.physics_steps < TO_SLEEP * 16


def test_what_is_not_on_tape_is_noticed_where_it_tells(
    cell: SimulatedCell, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tape, "_STATE", ("qpos", "qvel", "act", "qacc_warmstart"))  # not the controls
    found = played(cell, (BRAKED, 3), (OPENING, 5))
    assert (found.same, found.apart_s) == (0, pytest.approx(3 / 60))


def test_other_simulators_are_not_on_tape(cell: SimulatedCell) -> None:
    tape, (model, data) = Tape(cell), cell.truth.copy()
    with tape.recording():
        mujoco.mj_step(model, data)
    assert [move.call for stretch in tape.stretches for move in stretch.moves] == [
        "mj_resetData",
        "mj_forward",
    ]
