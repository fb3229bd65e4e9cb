"""The referee's judgement of an episode that has ended."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any, Final, Literal

from handeye.core.errors import HandeyeError
from handeye.core.record import Record
from handeye.env.jobs import Job
from handeye.judge.finding import Finding, Findings, all_right
from handeye.results.judging import findings_so_far, limited
from handeye.runs.runner import Runner

Outcome = Literal["right", "false done", "not done", "stopped"]
"""`right`: the policy reported that the work is done, and the referee agrees. `false done`: the policy reported that
the work is done, but the referee disagrees. `not done`: the time limit ended the episode, whatever the state of the
work. `stopped`: the arm stopped for good.
"""

REWARDS: Final[Mapping[Outcome, float]] = {"right": 1.0, "false done": -1.0, "not done": 0.0, "stopped": 0.0}
"""Reward at the end of an episode. Reporting `done` when the work is wrong costs more than giving up. The values are
our choice.
"""


class Verdict(Record, frozen=True, kw_only=True):
    """The referee's judgement of an episode."""

    outcome: Outcome
    findings: dict[str, Finding]  # those that the job requires
    reached: tuple[str, ...]  # steps of the work that are finished, up to the first that is not
    peak_N: float | None = None
    """Greatest true contact force (N) between pin and plate in any physics step; None if no witness in this cell
    records the contacts.
    """
    stopped: str = ""  # why the arm stopped for good

    @property
    def right(self) -> bool:
        """True if the work is right, whether or not the policy said that it is done."""
        return all_right(self.findings)

    @property
    def reward(self) -> float:
        """The reward at the end of the episode."""
        return REWARDS[self.outcome]

    def shown(self) -> dict[str, Any]:
        """Return the verdict as plain values, for `info["referee"]`."""
        return {
            "outcome": self.outcome,
            "right": self.right,
            "findings": {name: asdict(each) for name, each in self.findings.items()},
            "reached": list(self.reached),
            "peak_N": self.peak_N,
            "stopped": self.stopped,
        }


def verdict(job: Job, runner: Runner, *, done: bool, stopped: str = "") -> Verdict:
    """Let the referee judge the present state of an episode's cell.

    Args:
        done: the policy said that the work is done.
        stopped: why the arm stopped for good; empty if the arm did not stop for good.
    """
    found = {} if stopped else _required(job, runner)
    right = all_right(found)
    outcome: Outcome = (
        "stopped" if stopped else "not done" if not done else "right" if right else "false done"
    )
    return Verdict(
        outcome=outcome, findings=found, reached=_reached(job, found), peak_N=_peak(runner), stopped=stopped
    )


def _required(job: Job, runner: Runner) -> dict[str, Finding]:
    """Return the findings that the job requires. If the cell cannot be measured, there are no findings, and the work
    does not count as right.
    """
    try:
        every = findings_so_far(runner)
    except HandeyeError:
        return {}
    limits = {name: limit for name, limit in job.limits.items() if name in every}
    return {name: each for name, each in limited(every, limits).items() if job.requires(name)}


def _reached(job: Job, found: Findings) -> tuple[str, ...]:
    reached: list[str] = []
    for step, names in job.steps.items():
        mine = {name: each for name, each in found.items() if name.startswith(names)}
        if not all_right(mine):
            break
        reached.append(step)
    return tuple(reached)


def _peak(runner: Runner) -> float | None:
    """Return the greatest force (N) that the witness of the cell has measured, or None if the cell has no witness."""
    witness = getattr(runner.cell, "witness", None)
    return None if witness is None else round(float(witness.peak), 6)
