"""Carrying plans out in many worlds, each in a process of its own."""

import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import ExitStack, contextmanager
from functools import partial
from multiprocessing import active_children, get_context, resource_tracker
from typing import Any, TypeVar

from handeye.planfile.plan import Plan
from handeye.report.judging import Limits
from handeye.report.result import Result
from handeye.trials.assembly import run_plan
from handeye.variation import WorldSpec

Item = TypeVar("Item")
T = TypeVar("T")


def assemble_many(
    plan: Plan, worlds: Sequence[WorldSpec], *, camera: str, jobs: int, limits: Limits | None = None
) -> Iterator[Result]:
    """Results of a plan in many worlds, in the order they come."""
    yield from in_processes(partial(_result, plan, camera, limits), worlds, jobs)


def _result(plan: Plan, camera: str, limits: Limits | None, world: WorldSpec) -> Result:
    return run_plan(plan, world=world, camera=camera, limits=limits).result


def in_processes(trial: Callable[[Item], T], worlds: Sequence[Item], jobs: int) -> Iterator[T]:
    """What a trial comes to in many worlds, in the order they come; each in a process of its own making, so that none
    can sway another.

    Who stops asking for them ends those processes too.
    """
    with ExitStack() as closing:
        try:
            with _deaf_to_interrupts():
                pool = ProcessPoolExecutor(
                    jobs, get_context("spawn"), _begin, (trial,), max_tasks_per_child=1
                )
                closing.enter_context(pool)
                closing.callback(pool.shutdown, cancel_futures=True)
                runs = [pool.submit(_one, world) for world in worlds]
            for run in as_completed(runs):
                yield run.result()
        except BaseException:  # Ctrl-C first of all: a run under way would take minutes
            for process in active_children():
                process.terminate()
            raise


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """While processes are begun that shall not hear Ctrl-C at the terminal: we do, and end them without their words.

    Threads that begin here, and the processes that those begin, are deaf for good. We ourselves are interrupted, or
    told to end, when all have begun: half begun, one would not be known, and complain.

    Raises:
        KeyboardInterrupt: behind it, if we were interrupted or told to end meanwhile.
    """
    if not hasattr(signal, "pthread_sigmask"):  # as on Windows
        yield
        return
    resource_tracker.ensure_running()  # where it begins by itself, it takes the mask away
    masked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    told: list[int] = []
    handles = threading.current_thread() is threading.main_thread()  # no other thread may, or is interrupted
    # A thread of a library may be there that is not masked: it takes Ctrl-C to our handler all the same.
    before = {
        each: signal.signal(each, lambda number, _: told.append(number))
        for each in (signal.SIGINT, signal.SIGTERM)
        if handles
    }
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, masked)
        for each, handler in before.items():
            signal.signal(each, handler)
    if told:
        raise KeyboardInterrupt


_trial: Callable[[Any], Any]
"""What a process carries out in a world. It comes with the process and not with each world: a plan is too much for the
pipe of a pool, whose writer would wait for ever for processes that were ended."""


def _begin(trial: Callable[[Any], Any]) -> None:
    """Begin a process."""
    global _trial
    _trial = trial


def _one(world: Any) -> Any:
    return _trial(world)
