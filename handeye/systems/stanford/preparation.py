"""Preparation of a run: the arm measures its joints and calibrates the camera before the first instruction.

It does not depend on the instructions, so that runs of other programs can start from a kept one
(`systems/stanford/kept_calibrations.py`).
"""

from handeye.cell.simulated import SimulatedCell
from handeye.cell.state import CellState
from handeye.core.mutable_records import copied
from handeye.core.record import Record
from handeye.execution.context import ExecutionContext
from handeye.execution.state import DriveState, check_fits
from handeye.vision.calibration import Calibration


class Preparation(Record, frozen=True, kw_only=True):
    """The state of cell and run after the preparation."""

    cell: CellState
    drive: DriveState
    calibration: Calibration | None
    lens: float  # focal length of the lens in place, m
    friction_s: float  # simulated time in which the arm measured its friction and weighed its links


def preparation_of(run: ExecutionContext, cell: SimulatedCell, friction_s: float) -> Preparation:
    """The preparation that a run has just carried out."""
    return Preparation(
        cell=cell.capture(),
        drive=copied(run.state.drive),
        calibration=run.state.calibration,
        lens=run.state.lens,
        friction_s=friction_s,
    )


def take_up(preparation: Preparation, run: ExecutionContext, cell: SimulatedCell) -> None:
    """Put cell and run in the state after a preparation; InvalidInput, with nothing changed, if it does not fit."""
    state = copied(run.state)
    state.drive, state.lens = preparation.drive, preparation.lens
    state.calibration = preparation.calibration
    check_fits(state, run.plan, run.arm)
    cell.restore(preparation.cell)
    run.restore(state)
