"""The flow of a plan as a drawing that shows itself."""

from dataclasses import dataclass

from handeye.core.notebook import page, svg
from handeye.core.plain_text import counted
from handeye.inspection.drawing import flow_svg
from handeye.inspection.flow import flow
from handeye.planfile.plan import Plan


@dataclass(frozen=True, kw_only=True)
class FlowDrawing:
    """The steps of a plan, and the ways from one to the next, by themselves or on an error. Notebooks show it."""

    svg: str
    """The drawing, as `handeye inspect --graph svg` writes it."""
    about: str
    """What it shows, in words."""

    def __repr__(self) -> str:
        return f"<FlowDrawing {self.about}>"

    def _repr_html_(self) -> str:
        return page(svg(self.svg, self.about))


def flow_drawing(plan: Plan, stage: int | None = None) -> FlowDrawing:
    """The flow of a plan, or of one stage, by its number from 1."""
    graph = flow(plan, stage)
    of = graph.name if stage is None else f"{graph.name}, {graph.stages[stage - 1]}"
    return FlowDrawing(svg=flow_svg(graph), about=f"flow of {of}: {counted(len(graph.nodes), 'step')}")
