"""Executes runs in many worlds, and records each run in a folder of its own. Runs that have ended are not repeated."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from msgspec.structs import replace

from handeye.api.begin import begin
from handeye.api.plans import Plan
from handeye.api.run import Run
from handeye.core.errors import InvalidInput, Refused
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.datasets.episodes import EpisodeOutcome, outcome_of
from handeye.results.kept_run import kept_run
from handeye.runs.folder import RESULT
from handeye.runs.operator import NOBODY
from handeye.tasks import task
from handeye.trials.faults import chosen, usual
from handeye.trials.workers import in_processes


class RecordedWorld(Record, frozen=True, kw_only=True):
    """A world, and the name of the folder in which the run in this world is recorded."""

    name: str
    world: WorldSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class Recording:
    """Records a run of a plan in a world. If the run was interrupted, the run continues from its newest checkpoint."""

    folder: Path
    plan: Plan
    camera: str

    def __call__(self, where: RecordedWorld) -> EpisodeOutcome:
        """Return the outcome of the run. Raises InvalidInput if the run cannot be executed or recorded."""
        place = self.folder / where.name
        if not (place / RESULT).is_file():
            with _begun(place, self.plan, where.world, self.camera) as run:
                run.attend(NOBODY)
        return outcome_of(kept_run(place).result)


def _begun(place: Path, plan: Plan, world: WorldSpec, camera: str) -> Run:
    try:
        return begin(place, out=place)
    except InvalidInput:  # there is no such run yet, or none that can continue
        return begin(plan, world=world, camera=camera, judge=True, out=place, overwrite=True)


def worlds(plan: Plan, first: WorldSpec, n: int, faulty: int) -> tuple[RecordedWorld, ...]:
    """Return `n` worlds without faults, and then `faulty` worlds with one fault each. The seeds are consecutive, and
    the faults are taken from the task's standard set, one after another.

    Raises:
        Refused: the task has no standard set of faults.
    """
    sound = [replace(first, seed=first.seed + k) for k in range(n)]
    found = [RecordedWorld(name=f"seed-{world.seed}", world=world) for world in sound]
    if not faulty:
        return tuple(found)
    catalogue = task(plan.record.task).faults(first)
    if not catalogue.matrix:
        raise Refused(f"the task {plan.record.task} has no standard set of faults")
    faults = [*usual(catalogue, chosen(catalogue, ()), None, len(plan.record.program.stages)).values()]
    for k in range(faulty):
        fault = faults[k % len(faults)]
        world = replace(first, seed=first.seed + n + k, faults=(fault,))
        found.append(RecordedWorld(name=f"seed-{world.seed}-{fault.name}", world=world))
    return tuple(found)


def record_all(
    recording: Recording,
    wanted: tuple[RecordedWorld, ...],
    jobs: int,
    progress: Callable[[int, int], None] = lambda *_: None,
) -> dict[EpisodeOutcome, int]:
    """Record the missing runs in several processes. Returns the number of runs for each outcome.

    Raises:
        InvalidInput: a run cannot be executed or recorded.
    """
    recording.folder.mkdir(parents=True, exist_ok=True)
    outcomes: dict[EpisodeOutcome, int] = {}
    for done, outcome in enumerate(in_processes(recording, wanted, jobs), 1):
        outcomes[outcome] = outcomes.get(outcome, 0) + 1
        progress(done, len(wanted))
    return outcomes
