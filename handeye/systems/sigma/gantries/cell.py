"""The cell of the gantries: objects that slept when its state was captured fall asleep again at once."""

from typing import Final

import mujoco

from handeye.cell.snapshot_cell import SnapshotCell
from handeye.cell.state import CellState

_READY: Final = -1  # of a tree that falls asleep with the next physics step if it does not move


class BoardCell(SnapshotCell):
    """A cell whose objects stand still most of the time.

    Restoring a state wakes everything, and MuJoCo puts an object to sleep only after ten physics steps. A program
    of many short statements would therefore compute all objects in a third of the steps. An object sleeps with
    velocities of exactly 0, so the state shows which objects slept.
    """

    def restore(self, state: CellState) -> None:
        super().restore(state)
        model, data = self._model, self._data
        resting = model.tree_sleep_policy == mujoco.mjtSleepPolicy.mjSLEEP_AUTO_ALLOWED
        resting[model.dof_treeid[data.qvel != 0]] = False
        data.tree_asleep[resting] = _READY
