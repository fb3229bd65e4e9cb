"""Observers of a run, which cannot change it."""

from handeye.execution.servo import ServoPeriod
from handeye.program.events import AnyEvent
from handeye.runs.snapshot import Checkpoint


class Observer:
    """Base of the observers, which does nothing itself."""

    def event(self, event: AnyEvent) -> None:
        """An event has happened."""

    def tick(self, period: ServoPeriod) -> None:
        """A servo period has passed."""

    def undone(self, events: int) -> None:
        """The run went back: now only its first `events` events have happened."""

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        """A state to be kept has been reached."""

    def close(self) -> None:
        """The run has ended or was interrupted."""
