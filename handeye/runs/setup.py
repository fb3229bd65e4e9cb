"""The setup of a run: everything that determines its course."""

import msgspec

from handeye.core.entries import PLANNED, entry_named, refusal
from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan


class Setup(Record, frozen=True, kw_only=True):
    """Everything that determines the course of a run, if no person intervenes."""

    system: str = PLANNED  # name of the system that executes the run
    plan: Record  # the plan: a `Plan` if it is one of motions
    world: WorldSpec
    camera: str  # how to make pictures: `auto`, `gl` or `ray`
    judged: bool = False  # the referee judges the result; this does not change the course of the run
    limits: dict[str, float] = msgspec.field(default_factory=dict)
    """For each finding named here, a limit that replaces the limit of the task's referee, in the unit of the finding.
    """
    replaced: dict[str, str] = msgspec.field(default_factory=dict)  # the caller's own code, by part
    without: tuple[str, ...] = ()  # senses that are switched off for the program, in the order of `SENSES`

    @property
    def task(self) -> str:
        """Name of the task in the plan. Raises BadFile if the plan does not name a task."""
        name = getattr(self.plan, "task", None)
        if not isinstance(name, str):
            raise BadFile(f"the plan for {entry_named(self.system).title} does not name its task")
        return name


def plan_of(setup: Setup) -> Plan:
    """Return the plan of motions of a run. Raises Refused if the run's system does not execute plans of motions."""
    if not isinstance(setup.plan, Plan):
        raise refusal(setup.system, "plans")
    return setup.plan
