"""One whole run: a drawn world, a calibrated camera, a plan carried out, a referee's verdict."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from handeye.planfile.plan import Plan
from handeye.report.finishing import finished
from handeye.report.result import Result
from handeye.runs.advance import advance
from handeye.runs.folder import open_new
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.variation import WorldSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class Finished:
    """A run that has ended: what it came to, and all of it as it was left."""

    result: Result
    runner: Runner


def run_plan(
    plan: Plan,
    *,
    world: WorldSpec,
    camera: str = "auto",
    meter: Meter | None = None,
    referee: bool = True,
    observers: Callable[[Runner], Sequence[Observer]] = lambda _: (),
    folder: Path | None = None,
) -> Finished:
    """Carry out a plan in a world, with no operator there, and have it judged.

    Args:
        meter: measures what the run costs the host; by default from now on.
        folder: a new folder that keeps plan, events, trace, checkpoints, pictures and result.

    Raises:
        InvalidInput: the plan is for another arm, the camera cannot work as asked, or the folder cannot be had.
    """
    metered = meter or Meter()
    start = Checkpoint(setup=Setup(plan=plan, world=world, camera=camera))
    keeping = None if folder is None else open_new(folder, start)

    def looking(runner: Runner) -> Sequence[Observer]:
        kept = [] if keeping is None else [keeping.watch(runner, start, again=False, meter=metered)]
        return [*observers(runner), *kept]

    try:
        runner = Runner(start, observers=looking)
        result = finished(runner, advance(runner), metered, judged=referee, folder=keeping)
    finally:
        if keeping is not None:
            keeping.close()
    return Finished(result=result, runner=runner)
