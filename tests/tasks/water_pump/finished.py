"""A finished pump, put together by decree: for tests of what looks at it afterwards."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import mujoco
import numpy as np
from driving import tick

from handeye.cell.simulated import SimulatedCell
from handeye.cell.threads import Threads
from handeye.cell.truth import Truth
from handeye.core.pose import Pose, planar, pose, translated
from handeye.core.units import JIFFY
from handeye.judge.measured import SettledState
from handeye.runs.exported_state import ExportedState
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, standard
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.clamping import Clamping, ClampingState
from handeye.tasks.water_pump.referee import limits
from handeye.tasks.water_pump.world.pump_world import PumpWorld

TIGHTENING = 0.30  # N m


def put(truth: Truth, part: str, X_WP: Pose) -> None:
    """Put a free part somewhere, at rest."""
    model, data = truth.model, truth.data
    free = model.body_jntadr[model.body(part).id]
    start, dof = model.jnt_qposadr[free], model.jnt_dofadr[free]
    data.qpos[start : start + 3] = X_WP[:3, 3]
    mujoco.mju_mat2Quat(data.qpos[start + 3 : start + 7], X_WP[:3, :3].ravel())
    data.qvel[dof : dof + 6] = 0.0
    mujoco.mj_forward(model, data)


def stacked(world: PumpWorld | None = None, *, rest: bool = True) -> SimulatedCell:
    """Base against the blocks, gasket and top on it, nothing screwed."""
    cell = build_cell(world or PumpWorld.nominal(), camera="ray", rest=rest)
    blocks = cell.truth.data.body("blocks")
    X = pose(blocks.xmat.reshape(3, 3), blocks.xpos) @ translated(standard(), (1e-4, -1e-4, 0.0))
    top = base_top() + dimensions()("gasket.thickness")
    for part, height in (("base", 0.0), ("gasket", base_top()), ("top", top)):
        put(cell.truth, part, X @ planar(0.0, 0.0, height, 0.0))
    return cell


def threads_of(cell: SimulatedCell) -> Threads:
    """The threads of a cell."""
    (threads,) = (part for part in cell.truth.mechanisms if isinstance(part, Threads))
    return threads


def enter(cell: SimulatedCell, screw: int, hole: int, short: float, aside: float = 0.0) -> None:
    """Let a screw take its thread upright, short of its seat and beside the axis by so much (m)."""
    size, base = dimensions(), cell.truth.data.body("base")
    depth = size("screw.length") - size("top.flange") - size("gasket.thickness") - short
    X_WB, mouth = pose(base.xmat.reshape(3, 3), base.xpos), cell.truth.model.body(f"carrier{hole}").pos
    X_BS = translated(pose(np.eye(3), mouth), (aside, 0.0, -depth))
    threads_of(cell).take(screw, hole, X_WB @ X_BS)


def tighten(cell: SimulatedCell, hole: int) -> None:
    """Let a screw take its thread just under its head's full depth, and turn it home with a wrench."""
    for _ in tightening(cell, hole):
        pass


def tightening(cell: SimulatedCell, hole: int) -> Iterator[SimulatedCell]:
    """The same a servo period at a time: the cell at the end of each."""
    threads, truth = threads_of(cell), cell.truth
    enter(cell, hole, hole, 1e-4)
    dof = truth.model.joint(f"thread_turn{hole}").dofadr[0]
    for period in range(30):
        truth.data.qfrc_applied[dof] = -TIGHTENING if period < 20 else 0.0
        threads.rub(hole)
        tick(cell.devices)
        yield cell


@cache
def finished_cell(seed: int | None = None) -> SimulatedCell:
    """The cell with the finished pump in it, without errors or of the world of a seed: look, do not touch."""
    cell = stacked(None if seed is None else PumpWorld.sample(seed))
    for hole in range(6):
        tighten(cell, hole)
    for _ in range(round(0.2 / JIFFY)):
        tick(cell.devices)
    return cell


@cache
def _rested(seed: int | None) -> Truth:
    truth = finished_cell(seed).truth
    quiet = SettledState(truth, limits.SETTLE)
    return replace(truth, model=quiet.model, data=quiet.data)


def finished(seed: int | None = None) -> Truth:
    """A fresh copy of the finished pump."""
    return _copied(finished_cell(seed).truth)


def rested(seed: int | None = None) -> Truth:
    """The same after it has come to rest as the referee lets it, so that its forces are up to date."""
    return _copied(_rested(seed))


def _copied(truth: Truth) -> Truth:
    """A copy in which no welds hold the layers, so that they can be moved."""
    model, data = truth.copy()
    states = {**truth.states, Clamping.name: ClampingState(clamped=False)}
    return replace(truth, model=model, data=data, states=states)


def exhibit(truth: Truth) -> ExportedState:
    """The nominal world as a truth has it."""
    world = PumpWorld.nominal().drawn.spec
    return ExportedState(task="water_pump", world=world, moment="final", truth=truth, program="pump", steps=9)
