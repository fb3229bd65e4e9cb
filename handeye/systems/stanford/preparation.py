"""Preparation of a program: what the arm measures of itself and of the camera before the first instruction.

No instruction has a part in it, so that runs of many programs can begin with one that is kept
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
    """Cell and memory as they are when all has been measured."""

    cell: CellState
    drive: DriveState
    calibration: Calibration | None
    lens: float
    """Focal length of the lens that is in place, m."""
    friction_s: float
    """Simulated seconds in which the arm measured its friction and weighed its links."""


def preparation_of(run: ExecutionContext, cell: SimulatedCell, friction_s: float) -> Preparation:
    """The preparation that has just been carried out."""
    return Preparation(
        cell=cell.capture(),
        drive=copied(run.state.drive),
        calibration=run.state.calibration,
        lens=run.state.lens,
        friction_s=friction_s,
    )


def take_up(preparation: Preparation, run: ExecutionContext, cell: SimulatedCell) -> None:
    """Put a cell and what a run remembers where a preparation has left them.

    Raises:
        InvalidInput: it is of another cell or arm; nothing is changed.
    """
    state = copied(run.state)
    state.drive, state.lens = preparation.drive, preparation.lens
    state.calibration = preparation.calibration
    check_fits(state, run.plan, run.arm)
    cell.restore(preparation.cell)
    run.restore(state)
