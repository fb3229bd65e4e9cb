"""Observers that look on while a run goes on. No observer can change a run."""

from handeye.events import AnyEvent
from handeye.ports.workcell import Sensed
from handeye.pose import Array
from handeye.runs.snapshot import Checkpoint


class Observer:
    """Looks on; does nothing by itself."""

    def event(self, event: AnyEvent) -> None:
        """Something happened."""

    def tick(self, sensed: Sensed, effort: Array) -> None:
        """A servo period has passed, in which these torques, shape (n,), were put out."""

    def undone(self, events: int) -> None:
        """The run went back: only its first `events` events have happened."""

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        """A state worth keeping has been reached."""

    def close(self) -> None:
        """The run is over, or broken off."""
