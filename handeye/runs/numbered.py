"""Runs of programs with numbered lines. This module has the events and checks that all systems with numbered lines
share.
"""

from abc import abstractmethod
from typing import ClassVar, Literal

from handeye.core.entries import refusal
from handeye.core.errors import Refused
from handeye.core.plain_text import printable
from handeye.core.versions import versions
from handeye.execution.servo import Halted
from handeye.execution.state import ReversalOrder
from handeye.planfile.store import written_digest
from handeye.ports.camera import Renderer
from handeye.program.events import (
    AnyEvent,
    OperatorCalled,
    RunFinished,
    RunStarted,
    StageFinished,
    StageStarted,
)
from handeye.program.numbered import NumberedListing, NumberedStep
from handeye.program.system_state import SystemState
from handeye.runs.setup import Setup
from handeye.runs.system import RunCallbacks, RunningSystem


class NumberedRun(RunningSystem):
    """A run of a program of numbered lines. A step is one statement."""

    trouble = None
    system: ClassVar[str]

    def __init__(self, setup: Setup, around: RunCallbacks, listing: NumberedListing) -> None:
        self._setup, self._around, self._listing = setup, around, listing

    def _emit(self, event: AnyEvent) -> None:
        self._around.emit(event)

    def _poll(self) -> None:
        if self._around.halt():
            raise Halted

    def _started(self, plan: bytes) -> RunStarted:
        """Return the event that begins the run, given the encoded plan."""
        return RunStarted(
            system=self.system, time=0.0, program=self._listing.name, steps=len(self._listing.steps),
            plan=written_digest(plan), arm="", arm_digest="", world=self._setup.world,
            camera=Renderer(method="none"), versions=versions(), task=self._setup.task,
        )  # fmt: skip

    def _enter(self) -> tuple[int, NumberedStep]:
        """Return the next step and its number. Before the first step of the run, begin the run's only stage."""
        state = self.state
        assert state.at is not None
        if state.stage is None:
            state.stage = 0
            self._around.emit(StageStarted(time=self.time, stage=self._listing.name))
        self._poll()
        return state.at, self._listing.steps[state.at]

    def _stop(self, message: str, step: int) -> None:
        """Call the operator after a step."""
        state = self.state
        state.stopped = OperatorCalled(time=self.time, message=printable(message))
        state.at, state.onward = None, step
        self._emit(state.stopped)

    def _close(self, status: Literal["done", "skipped"]) -> None:
        """End the stage, if it has begun."""
        if self.state.stage is not None:
            self._around.emit(StageFinished(time=self.time, stage=self._listing.name, status=status))
            self.state.stage = None

    def _finish(self, *, completed: bool) -> bool:
        if not completed and self.state.stage is not None:  # the stage is kept, because results name it
            self._around.emit(StageFinished(time=self.time, stage=self._listing.name, status="stopped"))
        self._around.emit(RunFinished(time=self.time, completed=completed))
        return completed

    def _fits(self, state: SystemState) -> bool:
        """Return True if all places of a state are in this program."""
        numbers = [state.at, state.onward, *(place.step for place in state.places)]
        steps = range(len(self._listing.steps))
        return state.stage in (None, 0) and all(number is None or number in steps for number in numbers)

    def reverse(self, undoing: ReversalOrder) -> None:
        raise refusal(self.system, "undo")

    def set_value(self, what: str, name: str, value: tuple[float, ...]) -> None:
        settable = self.settables().get(what)
        if settable is None or name not in settable.names or len(value) != 1:
            raise Refused(f"{what} {name} cannot be set")
        self._set(what, name, value[0])

    @abstractmethod
    def _set(self, what: str, name: str, number: float) -> None:
        """Set the value `name` to `number`. The caller has checked that this value can be set."""
