"""Shanks with play in the holes of clamped layers are left out of the search for contacts, and no others."""

from functools import cache
from typing import Any

import mujoco
import numpy as np
import pytest
from driving import tick
from finished import enter, stacked, tighten

from handeye.cell.physics_stepper import PhysicsStepper
from handeye.cell.simulated import SimulatedCell
from handeye.cell.state import CellState
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.water_pump.clear_shanks import ClampedStepper


@cache
def clamped() -> tuple[SimulatedCell, CellState]:
    """Two screws clamp the layers."""
    cell = stacked()
    for hole in (0, 3):
        tighten(cell, hole)
    return cell, cell.capture()


def after(ticks: int, aside: float) -> tuple[SimulatedCell, bytes]:
    """The physics after some servo periods with a third screw in its thread, beside the axis by so much (m)."""
    cell, state = clamped()
    cell.restore(state)
    enter(cell, 4, 4, 0.002, aside=aside)
    for _ in range(ticks):
        tick(cell.devices)
    return cell, cell.capture().physics.tobytes()


def play() -> float:
    return dimensions()("top.screw_hole_radius") - dimensions()("screw.shank_radius")


@pytest.mark.slow
@pytest.mark.parametrize(("inside", "clear"), [(0.3e-3, True), (0.05e-3, False), (-0.05e-3, False)])
def test_a_shank_is_left_out_only_while_it_is_clear(
    inside: float, clear: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    step, seen = mujoco.mj_step, set[int]()
    shank = clamped()[0].truth.model.geom("shank4").id

    def watched(model: mujoco.MjModel, *rest: Any) -> None:
        seen.add(int(model.geom_conaffinity[shank]))
        step(model, *rest)

    monkeypatch.setattr(mujoco, "mj_step", watched)
    cell, _ = after(1, play() - inside)
    assert seen == {0 if clear else 4}
    assert cell.truth.model.geom_conaffinity[shank] == 4


@pytest.mark.slow
def test_leaving_shanks_out_changes_no_number(monkeypatch: pytest.MonkeyPatch) -> None:
    _, left_out = after(6, 0.0)
    monkeypatch.setattr(ClampedStepper, "step", PhysicsStepper.step)
    _, searched = after(6, 0.0)
    assert left_out == searched
    assert np.isfinite(np.frombuffer(left_out)).all()
