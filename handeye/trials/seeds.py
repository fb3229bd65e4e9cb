"""Assembling many pumps, one world each, and counting."""

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context

from handeye.planfile.plan import Plan
from handeye.report.result import Result
from handeye.trials.assembly import run_plan
from handeye.variation import WorldSpec


def assemble_many(plan: Plan, worlds: Sequence[WorldSpec], *, camera: str, jobs: int) -> Iterator[Result]:
    """Results in the order they come; each world in a process of its own making, so that none can sway another."""
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), max_tasks_per_child=1) as pool:
        runs = [pool.submit(_one, plan, world, camera) for world in worlds]
        try:
            for run in as_completed(runs):
                yield run.result()
        finally:
            for run in runs:
                run.cancel()


def _one(plan: Plan, world: WorldSpec, camera: str) -> Result:
    return run_plan(plan, world=world, camera=camera).result
