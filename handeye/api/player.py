"""The report of a trace within a notebook: one walks round the arm while the script goes by."""

from typing import TYPE_CHECKING, Final

from handeye.api.html import inked, line, page, sandbox
from handeye.core.errors import InvalidInput

if TYPE_CHECKING:
    from handeye.trace.trace import Trace

HEIGHT: Final = 640
"""Of its frame, pixels."""
_WITHOUT: Final = "A notebook shows the report without photographs; trace.frame(time) takes one."


def player(trace: "Trace") -> str:
    """The report in a frame of its own, with what it weighs, or why there is none."""
    try:
        file = _report(trace)
    except InvalidInput as fault:
        return page(line(inked(str(fault), "doubtful")))
    weighs = (
        f"The report of {trace.head.program}, {trace.head.world}: {len(file) / 1e6:.1f} MB in this notebook."
    )
    return page(line(weighs), sandbox(file, f"report of {trace.head.program}", HEIGHT))


def _report(trace: "Trace") -> bytes:
    """The page of the report.

    Raises:
        InvalidInput: the trace cannot be understood, or is of an older handeye.
    """
    from handeye.report.animation import animation
    from handeye.report.facts.scene import check_scene
    from handeye.report.page.document import report_page
    from handeye.report.photographs import no_album
    from handeye.report.recorded import Recorded

    run = Recorded(trace=trace)
    check_scene(run)
    return report_page(run, no_album(run, _WITHOUT), animation(run))
