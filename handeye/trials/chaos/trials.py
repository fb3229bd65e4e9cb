"""Many schedules, in several processes; those that fail are shrunk to the fewest things with which they do."""

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Final

from handeye.core.record import Record
from handeye.core.variation import Level, WorldSpec
from handeye.planfile.plan import Plan
from handeye.tasks.interface import Task
from handeye.trials.chaos.schedule import Schedule, draw
from handeye.trials.chaos.sound_run import SoundRun, sound_run
from handeye.trials.chaos.trial import Tried, shrunk, try_schedule
from handeye.trials.seeds import in_processes

LEVELS: Final[tuple[Level, ...]] = ("nominal", "low", "high")


class Outcome(Record, frozen=True, kw_only=True):
    """What one schedule came to."""

    drawn: Tried
    shrunk: Tried | None
    """The same with the fewest things with which it still fails; None: it does not fail."""


class Chaos(Record, frozen=True, kw_only=True):
    """What many schedules came to."""

    n: int
    broken: int
    failing: tuple[Outcome, ...]


def worlds(seed: int, count: int) -> list[WorldSpec]:
    """Worlds for the schedules of a seed: its own and those after it, one level after the other."""
    return [WorldSpec(seed=seed + number, level=LEVELS[number % len(LEVELS)]) for number in range(count)]


def sound_runs(
    plan: Plan, folder: Path, specs: Sequence[WorldSpec], camera: str, workers: int
) -> Iterator[SoundRun]:
    """The sound runs of some worlds in a folder, carried out now where it does not have them, in the order they end."""
    yield from in_processes(partial(sound_run, folder, plan, camera=camera), specs, workers)


def schedules(seed: int, count: int, runs: Sequence[SoundRun], work: Task) -> Iterator[Schedule]:
    """The first schedules of a seed."""
    for number in range(count):
        yield draw(
            number,
            seed,
            [(run.world.seed, run.world.level) for run in runs],
            [run.starts for run in runs],
            work.faults(seed),
            [run.stages for run in runs],
        )


def try_all(
    drawn: Sequence[Schedule], plan: Plan, folder: Path, camera: str, workers: int
) -> Iterator[Outcome]:
    """What schedules come to, in the order they end."""
    yield from in_processes(partial(outcome, plan=plan, folder=folder, camera=camera), drawn, workers)


def outcome(schedule: Schedule, plan: Plan, folder: Path, camera: str) -> Outcome:
    """What one schedule comes to; if it fails, with the fewest things with which it does.

    Raises:
        InvalidInput: it cannot be carried out.
    """
    sound = sound_run(folder, plan, WorldSpec(seed=schedule.seed, level=schedule.level), camera)
    tried = try_schedule(schedule, sound)
    if not tried.broken:
        return Outcome(drawn=tried, shrunk=None)
    return Outcome(drawn=tried, shrunk=shrunk(tried, schedule, lambda fewer: try_schedule(fewer, sound))[1])


def summed(outcomes: Sequence[Outcome]) -> Chaos:
    """Outcomes, those of failing schedules by their words."""
    failing = sorted((each for each in outcomes if each.drawn.broken), key=lambda each: each.drawn.schedule)
    return Chaos(n=len(outcomes), broken=len(failing), failing=tuple(failing))
