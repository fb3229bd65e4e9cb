"""Have the referee judge a finished run."""

from collections.abc import Callable, Mapping
from math import isfinite

from handeye.cell.truth import Truth
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName
from handeye.judge.finding import Finding, Findings
from handeye.runs.advance import Pause
from handeye.runs.runner import Runner

Referee = Callable[[Truth], Findings]  # Judges the truth of a cell; the cell is not touched
Limits = Mapping[str, float]  # Limits of findings by their names, each in the unit of the finding


def findings(runner: Runner, pause: Pause, referee: Referee | None = None) -> Findings:
    """Findings of a referee, by default the task's with the limits of the run; none before the program's end.

    After the arm has undone everything: whether all parts are back in place, and taught positions are as at first.
    """
    if pause.kind != "end":
        return {}
    truth = runner.cell.truth
    if runner.undone:
        return (
            {} if runner.system.executed else {**runner.task.judge_apart(truth), **runner.system.remembered()}
        )
    return limited(runner.task.judge(truth), runner.setup.limits) if referee is None else referee(truth)


def findings_so_far(runner: Runner) -> Findings:
    """The referee's findings on the present work, finished or not."""
    return runner.task.judge(runner.cell.truth)


def checked_findings(referee: str, findings: object) -> Findings:
    """The findings of a caller's own referee; raises InvalidInput if they are not findings."""
    if not isinstance(findings, Mapping) or not all(
        isinstance(name, str) and isinstance(each, Finding) for name, each in findings.items()
    ):
        raise BadArgument(
            f"the referee `{referee}` must return a dictionary of findings by name, not {findings!r}"
        )
    return findings


def checked_limits(limits: Limits) -> dict[str, float]:
    """The given limits as floats; raises InvalidInput for an unknown name or a limit that is not a number."""
    checked: dict[str, float] = {}
    for name, limit in limits.items():
        if not isinstance(name, str):
            raise BadArgument(f"limits must be given by the names of findings, not by {name!r}")
        if isinstance(limit, bool) or not isinstance(limit, (int, float)) or not isfinite(limit):
            raise BadArgument(f"the limit of {name} must be a number, not {limit!r}")
        checked[name] = float(limit)
    return checked


def check_limits(runner: Runner) -> None:
    """Check that each limit has a finding, before the run and not at its end; raises InvalidInput."""
    if runner.setup.limits:
        limited(runner.task.judge(runner.cell.truth), runner.setup.limits)


def limited(findings: Findings, limits: Limits) -> Findings:
    """Findings against other limits; raises InvalidInput if there is no finding of the name of a limit."""
    found = dict(findings)
    for name, limit in limits.items():
        if name not in found:
            near = suggestion(name, found) or f"there are {', '.join(map(quoted, found))}"
            raise NoSuchName(f"the referee has no finding {quoted(name)}; {near}")
        found[name] = found[name].limited(limit)
    return found
