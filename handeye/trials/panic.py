"""A panic button that is hit in the middle of a stage."""

from collections.abc import Sequence
from typing import Final

from handeye.execution.servo_period import ServoPeriod
from handeye.program.events import AnyEvent, StageStarted
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner

SOON: Final = 120
"""Servo periods of a stage, two seconds, after which the button is hit."""


class PanicInStage(Observer):
    """Hits the button once, when so many servo periods of a stage have passed."""

    def __init__(self, stage: int, periods: int = SOON) -> None:
        """Wait for a stage, by its index."""
        self._stage, self._left = stage, periods
        self._runner: Runner | None = None
        self._under_way = self._hit = False

    def watching(self, runner: Runner) -> Sequence[Observer]:
        """Look at a run; it is the only one who does."""
        self._runner = runner
        return [self]

    def down(self) -> bool:
        """True from when the button is hit until somebody has asked."""
        hit = self._under_way and self._left <= 0 and not self._hit
        self._hit = self._hit or hit
        return hit

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StageStarted) and self._runner is not None:
            self._under_way = self._runner.stages.index(event.stage) == self._stage

    def tick(self, period: ServoPeriod) -> None:
        self._left -= self._under_way
