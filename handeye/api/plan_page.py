"""The page of a plan for notebooks."""

from collections.abc import Sequence

from handeye.api.diagnostic import Diagnostic
from handeye.api.flow import FlowDrawing
from handeye.core.notebook import bar, frame, heading, page, svg, table
from handeye.core.plain_text import counted
from handeye.inspection.inspection import Inspection


def plan_page(found: Inspection, diagnostics: Sequence[Diagnostic], flow: FlowDrawing | None) -> str:
    """The stages of a plan with the time that each takes, what is doubtful about its script, and its flow."""
    longest = max((stage.seconds for stage in found.stages), default=0.0) or 1.0
    steps = sum(len(stage.steps) for stage in found.stages)
    said = (
        f"{found.name}: {counted(len(found.stages), 'stage')}, {counted(steps, 'step')}, "
        f"{counted(found.motions, 'motion')} of the {found.arm} arm, {found.seconds:.1f} s planned"
    )
    rows = [
        (each.number, each.name, len(each.steps), each.seconds, bar(each.seconds / longest))
        for each in found.stages
    ]
    shown = table(("", "stage", "steps", "motion, s", ""), rows)
    drawn = () if flow is None else (svg(flow.svg, flow.about),)
    return page(heading(said), shown, *(frame(str(each)) for each in diagnostics), *drawn)
