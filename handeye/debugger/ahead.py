"""What a run can still come by."""

from handeye.debugger.breakpoints import AtStage, AtSteps, UntilStep
from handeye.planfile.plan import Plan
from handeye.program.graph import Graph
from handeye.runs.advance import Stop
from handeye.runs.snapshot import Checkpoint


def is_ahead(stop: Stop, start: Checkpoint) -> bool:
    """Whether a run that begins at `start` can come to a place to stop at; an error may always come."""
    plan = start.setup.plan
    wanted = _steps(stop, plan)
    if wanted is None:
        return True
    at = 0 if start.snapshot is None else start.snapshot.state.at
    return at is not None and not wanted.isdisjoint(Graph(plan.program.steps).after([at]))


def _steps(stop: Stop, plan: Plan) -> frozenset[int] | None:
    """The steps that a place to stop at is before; None: it is no place."""
    match stop:
        case AtSteps():
            return stop.steps
        case UntilStep():
            return frozenset([stop.step])
        case AtStage():
            return frozenset(i for i, step in enumerate(plan.program.steps) if step.stage == stop.stage)
    return None
