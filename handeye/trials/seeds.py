"""Assembling many pumps, one world each, and counting."""

import signal
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from multiprocessing import active_children, get_context

from handeye.planfile.plan import Plan
from handeye.report.result import Result
from handeye.trials.assembly import run_plan
from handeye.variation import WorldSpec


def assemble_many(plan: Plan, worlds: Sequence[WorldSpec], *, camera: str, jobs: int) -> Iterator[Result]:
    """Results in the order they come; each world in a process of its own making, so that none can sway another.

    Who stops asking for them ends those processes too.
    """
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn"), max_tasks_per_child=1) as pool:
        with _deaf_to_interrupts():
            runs = [pool.submit(_one, plan, world, camera) for world in worlds]
        try:
            for run in as_completed(runs):
                yield run.result()
        except BaseException:  # Ctrl-C first of all: a run under way would take minutes
            for run in runs:
                run.cancel()
            for process in active_children():
                process.terminate()
            raise


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """While processes are begun that shall not hear Ctrl-C at the terminal: we do, and end them without their words.

    Threads that begin here, and the processes that those begin, are deaf for good.
    """
    if not hasattr(signal, "pthread_sigmask"):  # as on Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _one(plan: Plan, world: WorldSpec, camera: str) -> Result:
    return run_plan(plan, world=world, camera=camera).result
