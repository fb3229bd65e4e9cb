"""Stop conditions that a run can still come to."""

from handeye.planfile.plan import Plan
from handeye.program.graph import Graph
from handeye.runs.snapshot import Checkpoint
from handeye.runs.stops import AnyStop, AtStage, AtSteps


def is_ahead(stop: AnyStop, start: Checkpoint) -> bool:
    """A run that begins at `start` can come to a place to stop at; an error may always come."""
    plan = start.setup.plan
    wanted = _steps(stop, plan)
    if wanted is None:
        return True
    at = 0 if start.snapshot is None else start.snapshot.state.at
    return at is not None and not wanted.isdisjoint(Graph(plan.program.steps).after([at]))


def _steps(stop: AnyStop, plan: Plan) -> frozenset[int] | None:
    """The steps that a place to stop at is before; None: it is no place."""
    match stop:
        case AtSteps():
            return frozenset(stop.steps)
        case AtStage():
            return frozenset(i for i, step in enumerate(plan.program.steps) if step.stage == stop.stage)
    return None
