"""The jobs of the environments: where each episode starts, and what the referee requires at its end."""

from collections.abc import Mapping
from typing import Final

import msgspec

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import NoSuchName
from handeye.core.record import Record

ALWAYS: Final = (
    "as_drawn",
    "bonds",
    "numbers",
    "held",
    "motor",
    "still",
    "arm_still",
    "rest",
    "floor",
    "overlap",
)
"""Findings on the cell that must hold whatever part of the pump is built."""


class Job(Record, frozen=True, kw_only=True):
    """One job. An episode starts in the state in which the task's own program begins a stage of its work."""

    id: str  # name of the environment
    meaning: str  # sentence that says what has to be done
    task: str
    stages: tuple[int, ...] = (0,)
    """Stages of the program, from 0, before which an episode may start. If there are several, the seed chooses."""
    limit_s: float  # time limit of an episode, s on the cell's clock
    goal: tuple[str, ...] = ()
    """Beginnings of the names of the referee's findings that must hold. Empty: all findings must hold."""
    limits: Mapping[str, float] = msgspec.field(default_factory=dict)
    """Limits that replace the referee's own because only a part of the work is done, by finding."""
    steps: Mapping[str, tuple[str, ...]] = msgspec.field(default_factory=dict)
    """Steps of the work in their order, each with the beginnings of the names of the findings that show it."""

    def requires(self, finding: str) -> bool:
        """Return True if a finding of the referee must hold at the end of the job."""
        return not self.goal or finding.startswith((*self.goal, *ALWAYS))


JOBS: Final = (
    Job(
        id="handeye/Pin-v0",
        meaning="The hand holds a pin over a hole whose place is not exactly known. Insert the pin.",
        task="insertion",
        stages=(1,),
        limit_s=120.0,
        steps={"insert the pin": ("seat", "place")},
    ),
)


def job_named(name: str) -> Job:
    """Return the job of an environment. Raises NoSuchName if there is none."""
    found = {job.id: job for job in JOBS}
    if name not in found:
        near = suggestion(name, found) or f"the environments are {', '.join(map(quoted, found))}"
        raise NoSuchName(f"there is no environment {quoted(name)}; {near}")
    return found[name]
