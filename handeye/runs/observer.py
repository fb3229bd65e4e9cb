"""Defines observers of a run. Observers cannot change the run."""

from handeye.execution.servo import ServoPeriod
from handeye.program.events import AnyEvent
from handeye.runs.snapshot import Checkpoint


class Observer:
    """Base class of the observers. The base class does nothing."""

    def event(self, event: AnyEvent) -> None:
        """Called when an event has happened."""

    def tick(self, period: ServoPeriod) -> None:
        """Called when a servo period has passed."""

    def undone(self, events: int) -> None:
        """Called when the run has gone back to an earlier state. `events` is the number of events that remain; all
        later events are undone.
        """

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        """Called when a state that should be kept has been reached."""

    def close(self) -> None:
        """Called when the run has ended or was interrupted."""
