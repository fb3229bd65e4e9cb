"""Observers that save a run while a command executes it."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path

from handeye.core.errors import CannotWrite
from handeye.execution.servo import ServoPeriod
from handeye.program.events import AnyEvent
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.observer import Observer
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint


class StageKeeper(Observer):
    """Keeps, in a folder, the states at the beginnings of stages."""

    def __init__(self, folder: Path, setup: Setup) -> None:
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CannotWrite(f"the folder {folder} cannot be created: {error.strerror}") from None
        self._kept = CheckpointStore(folder)
        self._kept.claim(setup)

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        if checkpoint.between_stages and not checkpoint.touched:
            self._kept.save(checkpoint)


class OptionalRecord(Observer):
    """Saves a run for which the user named no folder. If the disk is full, the run continues without being saved."""

    def __init__(self, saving: Callable[[], AbstractContextManager[Observer]]) -> None:
        """`saving` returns a context that yields the folder. If writing fails, the context catches the error; later
        contexts yield an observer that saves nothing.
        """
        self._saving = saving

    def event(self, event: AnyEvent) -> None:
        with self._saving() as folder:
            folder.event(event)

    def tick(self, period: ServoPeriod) -> None:
        with self._saving() as folder:
            folder.tick(period)

    def undone(self, events: int) -> None:
        with self._saving() as folder:
            folder.undone(events)

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        with self._saving() as folder:
            folder.checkpoint(checkpoint)
