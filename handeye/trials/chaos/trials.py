"""Many schedules, in several processes; those that fail are shrunk to the fewest things with which they do."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Final

from handeye.core.variation import Level, WorldSpec
from handeye.runs.setup import Setup
from handeye.tasks.interface import AnyTask
from handeye.trials.chaos.schedule import Schedule, draw, parse_schedule
from handeye.trials.chaos.sound_run import SoundRun, sound_run
from handeye.trials.chaos.trial import ScheduleResult, shrunk, try_schedule
from handeye.trials.sweep import Case, Sweep, TrialRow
from handeye.trials.workers import in_processes

LEVELS: Final[tuple[Level, ...]] = ("nominal", "low", "high")


class ChaosRow(TrialRow, frozen=True, kw_only=True):
    """One schedule, which is the condition, tried."""

    drawn: ScheduleResult | None = None  # Its result; None: it broke off
    shrunk: ScheduleResult | None = None
    """The same with the fewest things with which it still fails; None: it does not fail."""

    @property
    def outcome(self) -> str:
        return "did not hold" if self.drawn is None or self.drawn.broken else "held"

    @property
    def detail(self) -> str:
        return super().detail if self.shrunk is None else "; ".join(map(str, self.shrunk.broken))


@dataclass(frozen=True, slots=True, kw_only=True)
class ChaosWork:
    """Tries schedules on the sound runs of a folder."""

    setup: Setup  # What the runs are but for their worlds
    folder: Path

    def __call__(self, case: Case) -> list[ChaosRow]:
        """Try one; if it fails, find the fewest things with which it does."""
        schedule = parse_schedule(case.condition)
        sound = sound_run(self.folder, self.setup, WorldSpec(seed=schedule.seed, level=schedule.level))
        drawn = try_schedule(schedule, sound)
        least = shrunk(drawn, schedule, lambda fewer: try_schedule(fewer, sound))[1] if drawn.broken else None
        return [
            ChaosRow(
                trial=case.trials[0], seed=case.seed, condition=case.condition, drawn=drawn, shrunk=least
            )
        ]


def worlds(seed: int, count: int, *, levels: bool = True) -> list[WorldSpec]:
    """Worlds for the schedules of a seed: its own and those after it, one level after the other if there are levels."""
    chosen = LEVELS if levels else LEVELS[:1]
    return [WorldSpec(seed=seed + number, level=chosen[number % len(chosen)]) for number in range(count)]


def sound_runs(setup: Setup, folder: Path, specs: Sequence[WorldSpec], jobs: int) -> Iterator[SoundRun]:
    """The sound runs of some worlds in a folder, carried out now where it does not have them, in the order they end."""
    yield from in_processes(partial(sound_run, folder, setup), specs, jobs)


def schedules(seed: int, count: int, runs: Sequence[SoundRun], work: AnyTask) -> Iterator[Schedule]:
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


def _sentence(row: ChaosRow) -> str:
    """What did not hold in a schedule that fails, and the command that shows it again."""
    if row.drawn is None:
        return f"{row.condition}: {row.detail}"
    if row.shrunk is None:
        return ""
    whole = "" if row.shrunk.schedule == row.condition else f"\n  shrunk from: {row.condition}"
    told = "\n".join(map(str, row.shrunk.broken))
    return f'{told}\n  handeye trials chaos --schedule "{row.shrunk.schedule}"{whole}'


def _more(rows: Sequence[ChaosRow]) -> dict[str, object]:
    failing = sorted((row for row in rows if row.drawn and row.drawn.broken), key=lambda row: row.condition)
    return {
        "broken": len(failing),
        "failing": [{"drawn": row.drawn, "shrunk": row.shrunk} for row in failing],
    }


CHAOS: Final = Sweep(
    kind="chaos",
    row=ChaosRow,
    outcomes={"held": "right", "did not hold": "silent"},
    success="held",
    noun="schedule",
    sentence=_sentence,
    more=_more,
)
