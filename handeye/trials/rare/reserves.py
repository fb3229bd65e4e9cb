"""Records how much reserve a program has left while it works. Searches, counted loops and checks have reserves."""

from typing import Final

import numpy as np

from handeye.program.events import AnyEvent, SearchAdvanced, StepFinished, StepStarted
from handeye.program.flow_operations import Countdown, Search
from handeye.program.motion_operations import Center, Change, Close, Height, Travel
from handeye.program.operation import Operation
from handeye.program.program import Program, Step
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.touch.senses import least_gap

_MM: Final = 1e3  # per metre


class Reserves(Observer):
    """Records, by name, the smallest reserves of a program. The reserve of a search is the number of untried places,
    and the reserve of a counted loop is the number of rounds left. The reserve of a measurement is its distance (mm)
    from the limit at which the program would have called the operator.

    A check is left out if the next step tests for the error of the check. The failure of such a check does not stop
    the program, which then takes another branch.
    """

    def __init__(self, runner: Runner) -> None:
        self._runner, self._program = runner, runner.context.plan.program
        self._limit, self._place = 0, ""
        self.left: dict[str, float] = {}

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StepStarted):
            operation = self._program.steps[event.step].operation
            if isinstance(operation, Search):
                self._limit, self._place = operation.limit, event.place
        elif isinstance(event, SearchAdvanced):
            self._note(f"remaining places of the search in line {self._place}", self._limit - event.count)
        elif isinstance(event, StepFinished):
            step = self._program.steps[event.step]
            if self._runner.context.state.pending is None and not is_tested(self._program, step):
                self._measure(step)

    def _measure(self, step: Step) -> None:
        operation, state = step.operation, self._runner.context.state
        if isinstance(operation, Countdown):
            self._note(f"remaining rounds of {operation.counter}", state.counters[operation.counter])
        elif isinstance(operation, Travel):
            self._between("travel", step, state.travel, operation.minimum, operation.maximum)
        elif isinstance(operation, Height):
            over = self._runner.context.drive.height - state.heights[operation.name]
            self._between("height", step, over, operation.minimum, operation.maximum)
        elif isinstance(operation, (Close, Center)):
            most = operation.maximum if isinstance(operation, Close) else None
            gap = self._runner.context.drive.sensed.gap
            self._between("gap", step, gap, least_gap(operation.minimum), most)
        elif isinstance(operation, Change) and operation.guards:
            way = float(np.linalg.norm(operation.displacement)) - state.travel
            self._note(f"distance left when a guard ended the motion, line {step.place}", _MM * way)

    def _between(self, what: str, step: Step, value: float, least: float, most: float | None) -> None:
        left = value - least if most is None else min(value - least, most - value)
        self._note(f"{what}, line {step.place}", _MM * left)

    def _note(self, name: str, left: float) -> None:
        self.left[name] = round(min(left, self.left.get(name, left)), 6)


def is_tested(program: Program, step: Step) -> bool:
    """Return True if the program tests for an error of a step instead of calling the operator."""
    following: Operation | None = None if step.next is None else program.steps[step.next].operation
    branch = None if following is None else following.branch
    return branch is not None and branch.error is not None
