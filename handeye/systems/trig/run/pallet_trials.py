"""Trials of the palletiser: taught, run, undone and judged in many worlds, to its end or broken off on its way."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Final

from handeye.core.errors import InvalidInput
from handeye.core.random_streams import random_numbers
from handeye.core.record import Record
from handeye.runs.runner import Runner
from handeye.systems.trig.run.job import JobReport, carried_out, setup_of_job
from handeye.trials.batch.rates import rate
from handeye.trials.seeds import in_processes

STEPS: Final = 14
"""That a block takes, at least, without those of the loops' ends."""
PLACES: Final = 15


class Failure(Record, frozen=True, kw_only=True):
    """A trial in which something was not right."""

    seed: int
    outcome: str
    told: str
    """By the program, and by the referee."""
    command: str
    """What carries it out again."""


class PalletFigures(Record, frozen=True, kw_only=True):
    """Trials counted."""

    n: int
    blocks: int
    interrupted: bool
    right: int
    stopped: int
    silent_failures: int
    wilson95: tuple[float, float] | None
    """Of the rate of those that were right."""
    most: Mapping[str, float]
    """The largest value of each finding, in its unit; those after undoing have `back.` before their names."""
    arm_s: float
    """Of the arm's clock, all together."""
    failures: tuple[Failure, ...]


def trials(n: int, *, seed: int, blocks: int, interrupt: bool, workers: int) -> Iterator[JobReport]:
    """So many trials, in the order they end; that of number k is in the world of seed + k."""
    seeds = [seed + number for number in range(n)]
    work = partial(tried, blocks, interrupt)
    yield from map(work, seeds) if workers == 1 or len(seeds) == 1 else in_processes(work, seeds, workers)


def tried(blocks: int, interrupt: bool, seed: int) -> JobReport:
    """One trial."""
    try:
        runner = Runner(setup_of_job("palletise", seed, blocks))
    except InvalidInput as error:  # by the arm: it cannot go where it is driven
        return JobReport(job="palletise", seed=seed, blocks=blocks, outcome="stopped", told=(str(error),))
    after = broken_off_after(seed, blocks) if interrupt else None
    return carried_out(runner, after=after)


def broken_off_after(seed: int, blocks: int) -> int:
    """Steps after which a run is broken off in the world of a seed: any number that it has."""
    most = 3 + STEPS * min(blocks, PLACES)
    return int(random_numbers(seed, "pallet.interrupt").integers(1, most, endpoint=True))


def figures(found: Sequence[JobReport], blocks: int, *, interrupt: bool) -> PalletFigures:
    """Count trials."""
    outcomes = [each.outcome for each in found]
    right = outcomes.count("right")
    failures = (each for each in sorted(found, key=lambda each: each.seed) if each.outcome != "right")
    return PalletFigures(
        n=len(found),
        blocks=blocks,
        interrupted=interrupt,
        right=right,
        stopped=outcomes.count("stopped"),
        silent_failures=outcomes.count("silent"),
        wilson95=rate(right, len(found)).wilson95,
        most=_most(found),
        arm_s=round(sum(each.arm_s for each in found), 3),
        failures=tuple(_failure(each) for each in failures),
    )


def _most(found: Sequence[JobReport]) -> dict[str, float]:
    most: dict[str, float] = {}
    for each in found:
        for before, checks in (("", each.checks), ("back.", each.checks_back)):
            for name, check in checks.items():
                most[before + name] = max(most.get(before + name, 0.0), check.value)
    return most


def _failure(found: JobReport) -> Failure:
    told = "; ".join((*found.told, *(check.told for check in found.wrong)))
    options = f"--n 1 --seed {found.seed} --blocks {found.blocks}"
    broken = " --interrupt" if found.interrupted_after is not None else ""
    command = f"handeye trials pallet {options}{broken}"
    return Failure(seed=found.seed, outcome=found.outcome, told=told, command=command)
