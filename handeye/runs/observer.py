"""Observers of a run. None can change it."""

from handeye.execution.servo import ServoPeriod
from handeye.program.events import AnyEvent
from handeye.runs.snapshot import Checkpoint


class Observer:
    """Base of the observers; does nothing by itself."""

    def event(self, event: AnyEvent) -> None:
        """Something happened."""

    def tick(self, period: ServoPeriod) -> None:
        """A servo period has passed."""

    def undone(self, events: int) -> None:
        """The run went back: only its first `events` events have happened."""

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        """A state worth keeping has been reached."""

    def close(self) -> None:
        """The run is over, or interrupted."""
