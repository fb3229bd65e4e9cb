"""Reads the tables of a run from its folder."""

from pathlib import Path
from typing import Final

from handeye.core.files import read_whole
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.folder import CHECKPOINTS
from handeye.systems.ml.dashboard.history import History, unpacked
from handeye.systems.ml.run.plan import MlPlan
from handeye.systems.ml.run.state import MlState, tables_of

TABLES: Final = "tables.gz"
_LARGEST: Final = 50_000_000  # bytes


def kept_history(folder: Path) -> History | None:
    """Return the tables of a run. If the run was interrupted, the tables end at the run's newest checkpoint. Returns
    None if the folder has no tables. Raises BadFile if the file of the tables is not valid.
    """
    path = folder / TABLES
    if path.is_file():
        return unpacked(read_whole(path, _LARGEST), str(path))
    newest, _ = CheckpointStore(folder / CHECKPOINTS).newest()
    if newest is None or newest.snapshot is None or not isinstance(newest.snapshot.state, MlState):
        return None
    assert isinstance(newest.setup.plan, MlPlan)
    return tables_of(newest.setup.plan, newest.snapshot.state)
