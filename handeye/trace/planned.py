"""The plan that a recorded run followed."""

from handeye.core.diagnostics import quoted
from handeye.core.errors import Refused
from handeye.planfile.plan import Plan
from handeye.planfile.store import decode
from handeye.trace.trace import Trace


def plan_of(trace: Trace) -> Plan:
    """The plan of the program that was carried out.

    Raises:
        InvalidInput: it is not sound, or another system carried the run out.
    """
    if trace.head.system != "program":
        raise Refused(
            f"{trace.name} is of a run of the system {quoted(trace.head.system)}, which follows no plan of motions"
        )
    return decode(trace.plan, f"the plan in {trace.name}")
