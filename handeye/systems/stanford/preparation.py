"""Prepares a run: the arm measures its joints and calibrates the camera before the first instruction.

The preparation does not depend on the instructions, so runs of other programs can start from a stored
preparation (`systems/stanford/kept_calibrations.py`). Equal conditions give equal preparations, byte for byte.
"""

import platform

import msgspec
import numpy as np

from handeye.cell.simulated import SimulatedCell
from handeye.cell.state import CellState
from handeye.core.mutable_records import copied
from handeye.core.processor import processor
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.core.versions import code_digest, versions
from handeye.execution.context import ExecutionContext
from handeye.execution.state import DriveState, check_fits
from handeye.ports.camera import Renderer
from handeye.runs.setup import Setup, plan_of
from handeye.tasks import task
from handeye.vision.calibration import Calibration


class Preparation(Record, frozen=True, kw_only=True):
    """The state of the cell and of the run after the preparation."""

    cell: CellState
    drive: DriveState
    calibration: Calibration | None
    lens: float  # focal length of the lens in place, m
    seconds: float  # simulated time that it took
    friction_s: float  # part of it in which the arm measured its friction and weighed its links


def preparation_of(
    run: ExecutionContext, cell: SimulatedCell, seconds: float, friction_s: float
) -> Preparation:
    """Return the preparation that a run has just completed. The clock of the cell must be 0."""
    return Preparation(
        cell=cell.capture(),
        drive=copied(run.state.drive),
        calibration=run.state.calibration,
        lens=run.state.lens,
        seconds=seconds,
        friction_s=friction_s,
    )


def take_up(preparation: Preparation, run: ExecutionContext, cell: SimulatedCell) -> None:
    """Set the cell and the run to the state after a preparation. If the preparation does not fit, change nothing and
    raise InvalidInput.
    """
    state = copied(run.state)
    state.drive, state.lens = preparation.drive, preparation.lens
    state.calibration = preparation.calibration
    check_fits(state, run.plan, run.arm)
    cell.restore(preparation.cell)
    run.restore(state)


class Conditions(Record, frozen=True, kw_only=True):
    """Everything on which the result of a preparation depends."""

    task: str
    world: WorldSpec
    camera: Renderer
    driver: str  # description that OpenGL gives of itself, or ""
    feels: bool  # the arm measures its joints first
    versions: dict[str, str]
    code: str  # digest of handeye's code and scenes
    machine: tuple[str, ...]  # kind of processor, since rounding depends on it

    @property
    def line(self) -> bytes:
        """The conditions as one line of JSON. Equal conditions give equal lines."""
        return msgspec.json.encode(self, order="deterministic")


def conditions_of(setup: Setup, camera: Renderer) -> Conditions | None:
    """Return the conditions of a run with this renderer, or None if the run uses the caller's own code."""
    ours = type(task(setup.task)).__module__.startswith("handeye.")
    if camera.method == "replaced" or not ours:
        return None
    instructions = np.show_config(mode="dicts")["SIMD Extensions"]["found"]  # that NumPy has found here
    return Conditions(
        task=setup.task,
        world=setup.world,
        camera=camera,
        driver=_driver(camera),
        feels=plan_of(setup).program.feels,
        versions=versions(),
        code=code_digest(),
        machine=(platform.system(), processor(), *instructions),
    )


def _driver(camera: Renderer) -> str:
    if camera.method != "opengl":
        return ""
    from handeye.cell.opengl import driver

    return driver()
