"""Lets the referee judge a run."""

from collections.abc import Callable, Mapping
from math import isfinite

from handeye.cell.truth import Truth
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName
from handeye.judge.finding import Finding, Findings
from handeye.runs.advance import Pause
from handeye.runs.runner import Runner

Referee = Callable[[Truth], Findings]  # Judges the true state of a cell, without changing it
Limits = Mapping[str, float]  # Limits of findings by their names, each in the unit of the finding


def findings(runner: Runner, pause: Pause, referee: Referee | None = None) -> Findings:
    """Return the findings of a referee. If `referee` is None, the task's referee judges the run with the limits of the
    run. If the program has not ended, there are findings only if it has stopped, not merely paused, and the task's
    referee also measures unfinished work.

    If the arm has undone all its work, the findings say whether all parts are back in their places, and whether
    the taught positions are unchanged.
    """
    if pause.kind != "end" and not (pause.kind in ("operator", "trouble") and runner.task.judges_stopped):
        return {}
    truth = runner.cell.truth
    if runner.undone:
        return (
            {} if runner.system.executed else {**runner.task.judge_apart(truth), **runner.system.remembered()}
        )
    return limited(runner.task.judge(truth), runner.setup.limits) if referee is None else referee(truth)


def findings_so_far(runner: Runner) -> Findings:
    """Return the findings of the task's referee on the present state of the work, finished or not."""
    return runner.task.judge(runner.cell.truth)


def findings_after(runner: Runner, done: int) -> Findings:
    """Return those findings of the task's referee that must hold after `done` stages of the task's own program. The
    findings are on the present state of the work.
    """
    task = runner.task
    found = {
        name: finding
        for name, finding in findings_so_far(runner).items()
        if any(name.startswith(words) and done >= stage for words, stage in task.holds_from.items())
    }
    return {**found, **task.judge_between(runner.cell.truth, done)}


def checked_findings(referee: str, findings: object) -> Findings:
    """Check the value that a caller's own referee returned. Raises InvalidInput if the value is not a dictionary from
    names to findings.
    """
    if not isinstance(findings, Mapping) or not all(
        isinstance(name, str) and isinstance(each, Finding) for name, each in findings.items()
    ):
        raise BadArgument(
            f"the referee `{referee}` must return a dictionary from names to findings, not {findings!r}"
        )
    return findings


def checked_limits(limits: Limits) -> dict[str, float]:
    """Return the limits as floats. Raises InvalidInput if a limit is not a number, or if a key of `limits` is not the
    name of a finding.
    """
    checked: dict[str, float] = {}
    for name, limit in limits.items():
        if not isinstance(name, str):
            raise BadArgument(f"a limit must have the name of a finding as its key, not {name!r}")
        if isinstance(limit, bool) or not isinstance(limit, (int, float)) or not isfinite(limit):
            raise BadArgument(f"the limit of {name} must be a number, not {limit!r}")
        checked[name] = float(limit)
    return checked


def check_limits(runner: Runner) -> None:
    """Check, before a run begins, that each limit belongs to a finding. Raises InvalidInput if a limit does not belong
    to a finding.
    """
    if runner.setup.limits:
        limited(runner.task.judge(runner.cell.truth), runner.setup.limits)


def limited(findings: Findings, limits: Limits) -> Findings:
    """Return the findings with other limits. If `limits` contains a limit for a finding, this limit replaces the
    finding's own limit. Raises InvalidInput if a limit belongs to no finding.
    """
    found = dict(findings)
    for name, limit in limits.items():
        if name not in found:
            near = suggestion(name, found) or f"the findings are {', '.join(map(quoted, found))}"
            raise NoSuchName(f"the referee has no finding {quoted(name)}; {near}")
        found[name] = found[name].limited(limit)
    return found
