"""The plan that a recorded run followed."""

from handeye.core.entries import entry_named, require
from handeye.planfile.plan import Plan
from handeye.planfile.store import decode
from handeye.trace.trace import Trace


def plan_of(trace: Trace) -> Plan:
    """The plan that was carried out; raises InvalidInput if it is not sound, or the system follows none."""
    require(trace.head.system, "plans", trace.name)
    return decode(trace.plan, f"the plan in {trace.name}")


def stage_names(trace: Trace) -> tuple[str, ...]:
    """The stages of the program; of a system that follows no plan of motions, those that began."""
    if "plans" in entry_named(trace.head.system).can:
        return plan_of(trace).program.stages
    return tuple(dict.fromkeys(stage.name for stage in trace.stages))
