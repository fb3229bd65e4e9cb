"""Carrying plans out in many worlds, in several processes."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TypeVar

from handeye.core.errors import HandeyeError
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.results.judging import Limits
from handeye.results.result import Result
from handeye.trials.assembly import run_plan
from handeye.trials.workers import answers

Item = TypeVar("Item")
T = TypeVar("T")


class WorkerLost(HandeyeError):
    """The process of a trial was killed, and again when the trial was tried once more."""


def assemble_many(
    plan: Plan, worlds: Sequence[WorldSpec], *, camera: str, jobs: int, limits: Limits | None = None
) -> Iterator[Result]:
    """Results of a plan in many worlds, in the order they come.

    Raises:
        WorkerLost: the process of one was killed twice.
    """
    yield from in_processes(partial(_result, plan, camera, limits), worlds, jobs)


def _result(plan: Plan, camera: str, limits: Limits | None, world: WorldSpec) -> Result:
    return run_plan(plan, world=world, camera=camera, limits=limits).result


def in_processes(trial: Callable[[Item], T], worlds: Sequence[Item], jobs: int) -> Iterator[T]:
    """What a trial comes to in many worlds, in the order they come.

    Who stops asking for them ends the processes too.

    Raises:
        WorkerLost: the process of one was killed twice.
        Exception: what a trial raises.
    """
    for answer in answers(trial, worlds, jobs):
        if answer.error is not None:
            raise answer.error
        if answer.value is None:
            raise WorkerLost(
                f"the process of a trial was killed {answer.killed} times, as it is where memory is short: try fewer "
                "at a time"
            )
        yield answer.value
