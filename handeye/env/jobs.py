"""The jobs of the environments: where each episode starts, and what the referee requires at its end.

This module has the jobs of tasks with planned programs. A system without planned programs names its jobs in its
`Entry`.
"""

from collections.abc import Mapping
from typing import Final

import msgspec

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.entries import entries, loaded
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
"""Findings about the cell. They must hold in every job, whichever part of the pump it builds."""


class Job(Record, frozen=True, kw_only=True):
    """One job. An episode starts in the state in which the task's own program begins one of its stages."""

    id: str  # name of the environment
    meaning: str  # sentence that says what has to be done
    task: str
    machine: str = "handeye.env.controlled_arm:ControlledArm"
    """`module:NAME` of the class of the job's machine, derived from `handeye.env.controls.ControlledMachine`."""
    policies: Mapping[str, str] = msgspec.field(default_factory=dict)
    """Policies that are included with handeye for this job only. Each key is the name of a policy. Its value is the
    `module:NAME` of the class or function that makes the policy.
    """
    stages: tuple[int, ...] = (0,)
    """Numbers of the stages before which an episode may start; the first stage of the program is 0. If there are
    several numbers, the seed chooses one.
    """
    until: int | None = None  # stage of the program, from 0, before which the job ends; None: its end
    limit_s: float  # time limit of an episode, s on the cell's clock
    goal: tuple[str, ...] = ()
    """The findings of the referee that must hold, each given by the beginning of its name. If the tuple is empty, all
    findings must hold.
    """
    limits: Mapping[str, float] = msgspec.field(default_factory=dict)
    """Limits that replace the referee's limits for some findings, in a job that leaves out a part of the work.
    """
    plants: tuple[str, ...] = ()
    """The faults that can be planted at the start. The seed determines the fault and its size."""
    sizes: tuple[float, float] = (0.0, 0.0)  # least and greatest size of a planted fault, in the fault's unit
    steps: Mapping[str, tuple[str, ...]] = msgspec.field(default_factory=dict)
    """Steps of the work, in their order. For the name of each step, the findings that must hold if the step is done. A
    finding is given by the beginning of its name.
    """

    def requires(self, finding: str) -> bool:
        """Return True if a finding of the referee must hold at the end of the job."""
        return not self.goal or finding.startswith((*self.goal, *ALWAYS))


_LAYERS: Final = {
    "stand the base at its blocks": ("base",),
    "lay the gasket": ("gasket",),
    "lay the top": ("top",),
}
_SCREWS: Final = {"drive the screws": ("screws",)}
_PUMP: Final = {
    **_LAYERS,
    **_SCREWS,
    "put pins and screwdriver back": ("pins", "rack"),
    "leave the rotor free": ("rotor",),
}
_PART: Final = ("base", "gasket", "top", "rack", "dispenser")
"""Findings that must hold for an unfinished pump: those about the layers, the screwdriver in its rack, and the
dispenser.
"""

PLANNED: Final = (
    Job(
        id="handeye/Pin-v0",
        meaning="The hand holds a pin over a hole whose place is not exactly known. Insert the pin.",
        task="insertion",
        stages=(1,),
        limit_s=120.0,
        steps={"insert the pin": ("seat", "place")},
    ),
    Job(
        id="handeye/Screw-v0",
        meaning="Base, gasket and top lie on two aligning pins. Drive the first two screws, and put the screwdriver "
        "back.",
        task="water_pump",
        stages=(7,),
        until=8,
        limit_s=240.0,
        goal=(*_PART, "screws"),
        limits={"screws": 2.0},
        steps={**_LAYERS, **_SCREWS, "put the screwdriver back": ("rack",)},
    ),
    Job(
        id="handeye/GasketAndTop-v0",
        meaning="The base stands at its blocks, with two aligning pins. Lay the gasket and the top on it.",
        task="water_pump",
        stages=(4,),
        until=7,
        limit_s=240.0,
        goal=_PART,
        steps=_LAYERS,
    ),
    Job(
        id="handeye/Pump-v0",
        meaning="The base lies somewhere on the belt. Assemble the whole pump.",
        task="water_pump",
        stages=(0,),
        limit_s=1800.0,
        steps=_PUMP,
    ),
    Job(
        id="handeye/Resume-v0",
        meaning="The program has stopped before one of its stages. Finish the pump.",
        task="water_pump",
        stages=tuple(range(12)),
        limit_s=1800.0,
        steps=_PUMP,
    ),
    Job(
        id="handeye/Mend-v0",
        meaning="The pump is assembled, but one of its screws is loose. Find the screw and tighten it.",
        task="water_pump",
        stages=(11,),
        limit_s=900.0,
        plants=tuple(f"screw.{number}.loose" for number in range(1, 7)),
        sizes=(0.5, 1.5),
        steps=_PUMP,
    ),
)


def ids() -> tuple[str, ...]:
    """Return the ids of all environments. No system is loaded."""
    return (*(job.id for job in PLANNED), *_elsewhere())


def jobs() -> tuple[Job, ...]:
    """Return the jobs of all environments. Raises InvalidInput if a system's job cannot be imported."""
    return tuple(map(job_named, ids()))


def job_named(name: str) -> Job:
    """Return the job of an environment. Raises NoSuchName if there is no such environment."""
    found = next((job for job in PLANNED if job.id == name), None)
    if found is not None:
        return found
    places = _elsewhere()
    if not isinstance(name, str) or name not in places:
        name, known = str(name), ids()
        near = suggestion(name, known) or f"the environments are {', '.join(map(quoted, known))}"
        raise NoSuchName(f"there is no environment {quoted(name)}; {near}")
    job: Job = loaded(places[name])
    return job


def _elsewhere() -> Mapping[str, str]:
    """For each environment that a system names in its entry, return the location from which the environment's job is
    imported.
    """
    return {name: place for entry in entries().values() for name, place in entry.environments.items()}
