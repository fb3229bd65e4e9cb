"""Trials that carry out no program, spread over worlds and processes."""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from handeye.core.variation import WorldSpec
from handeye.tasks import task
from handeye.tasks.trial import Attempt, Known
from handeye.trials.seeds import in_processes


@dataclass(frozen=True, slots=True, kw_only=True)
class Tried:
    """Attempts in one world."""

    attempts: tuple[Attempt, ...]
    cpu_s: float
    """Of this process and its threads, calibration and scene included."""


def try_in(
    of: str, name: str, worlds: Sequence[WorldSpec], number: int, *, camera: str, known: Known, jobs: int
) -> Iterator[Tried]:
    """`number` attempts at a trial of a task, spread evenly over worlds; in the order they end."""
    share, rest = divmod(number, len(worlds))
    shares = [(world, share + (n < rest)) for n, world in enumerate(worlds)]
    work = partial(_tried, of, name, camera, known)
    yield from map(work, shares) if min(jobs, len(shares)) == 1 else in_processes(work, shares, jobs)


def _tried(of: str, name: str, camera: str, known: Known, share: tuple[WorldSpec, int]) -> Tried:
    trial: Any = task(of).trials[name]
    world, number = share
    start = time.process_time()
    attempts = tuple(trial.attempts(world, number, camera=camera, known=known))
    return Tried(attempts=attempts, cpu_s=time.process_time() - start)
