"""The referee is called to a run that is over."""

from collections.abc import Callable, Mapping
from math import isfinite

from handeye.cell.truth import Truth
from handeye.diagnostics import quoted, suggestion
from handeye.errors import InvalidInput
from handeye.judge.finding import Findings
from handeye.runs.advance import Pause
from handeye.runs.runner import Runner
from handeye.tasks.task import Task

Referee = Callable[[Truth], Findings]
"""Judges the truth of a cell; the cell is not touched."""
Limits = Mapping[str, float]
"""Limits of findings by their names, each in the unit of the finding."""


def findings(runner: Runner, pause: Pause, referee: Referee | None = None) -> Findings:
    """Ask a referee, by default that of the task; nothing of a program that did not come to its end."""
    if pause.kind != "end":
        return {}
    return runner.task.judge(runner.cell.truth) if referee is None else referee(runner.cell.truth)


class LimitedReferee:
    """Finds what the referee of a task finds, against other limits."""

    def __init__(self, limits: Limits, task: Task) -> None:
        """Raises InvalidInput if a limit is no number."""
        self._limits, self._task = dict(limits), task
        for name, limit in self._limits.items():
            if not isinstance(name, str):
                raise InvalidInput(f"limits are given by the names of findings, not by {name!r}")
            if isinstance(limit, bool) or not isinstance(limit, (int, float)) or not isfinite(limit):
                raise InvalidInput(f"the limit of {name} must be a number, not {limit!r}")
        said = ", ".join(f"{name}={limit:g}" for name, limit in self._limits.items())
        self.__qualname__ = f"limits({said})"

    def __call__(self, truth: Truth) -> Findings:
        """The findings.

        Raises:
            InvalidInput: the referee of the task has no finding of the name of a limit.
        """
        found = dict(self._task.judge(truth))
        for name, limit in self._limits.items():
            if name not in found:
                near = suggestion(name, found) or f"there are {', '.join(map(quoted, found))}"
                raise InvalidInput(f"the referee has no finding {quoted(name)}; {near}")
            found[name] = found[name].limited(limit)
        return found
