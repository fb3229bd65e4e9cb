"""Insertion bench: one pin put into one hole, in many worlds and with many errors of the hole's place.

A trial begins where the program has fetched the pin and holds it over the hole, and is what follows: search, insertion,
check. What is fetched in one world is the beginning of several trials, each with another hole.
"""

import math
from collections.abc import Iterator, Sequence
from functools import cache, partial
from typing import Final, Literal

import numpy as np
from msgspec.structs import replace

from handeye.al import AL
from handeye.cell.state import noise_state
from handeye.core.random_streams import random_numbers
from handeye.core.record import Record
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.core.units import INCH, MILLIMETRE
from handeye.core.variation import Overrides, WorldSpec
from handeye.execution.servo_period import ServoPeriod
from handeye.planfile.plan import Plan
from handeye.planning.scripts import plan_source
from handeye.program.cause_text import call_sentence
from handeye.program.events import SearchAdvanced
from handeye.runs.advance import advance
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.scripts import taught_beside
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.tasks.inserting import CHAMFER, CLEARANCE, SPREAD, Inserting
from handeye.trials.seeds import in_processes

Search = Literal["gentle", "1973"]
TASK: Final = "insertion"
TRIALS_A_WORLD: Final = 10
"""Chosen: the pin is fetched once for so many trials, which takes a second of a processor."""
_WRITTEN_STEP: Final = "SEARCH  .07"
_STEP_SHARE: Final = 0.92
"""Of the coarsest step of a search in which each hole is caught, the share that is taken: .07 in for Factory's hole."""
_PLACE: Final = 0.005
"""in, to which it is rounded down."""


def bench() -> Inserting:
    """The task of the bench."""
    found = task(TASK)
    assert isinstance(found, Inserting)
    return found


class Condition(Record, frozen=True, kw_only=True):
    """What is tried."""

    clearance: float = CLEARANCE
    """Of the hole, in diameter, mm."""
    chamfer: float = CHAMFER
    """mm"""
    sd: float = SPREAD
    """Sigma of the error of the hole's place along x and along y, mm."""
    search: Search = "gentle"

    @property
    def step(self) -> float:
        """Step of the search, in: by the rule that the worst place between four of them is still caught."""
        caught = bench().caught(self.clearance * MILLIMETRE, self.chamfer * MILLIMETRE)
        return max(1, math.floor(_STEP_SHARE * math.sqrt(2) * caught / INCH / _PLACE)) * _PLACE

    @property
    def hole(self) -> dict[str, float]:
        """Quantities of a world with its hole, where it was taught."""
        return bench().hole(self.clearance * MILLIMETRE, self.chamfer * MILLIMETRE)

    @property
    def plan(self) -> Plan:
        """The plan that is carried out."""
        return _plan(self.search, self.step)


def grid(search: Search) -> list[Condition]:
    """Conditions around Factory's setting, which comes first, one thing changed at a time."""
    return [
        Condition(search=search),
        *(Condition(search=search, clearance=clearance) for clearance in (0.05, 0.3, 1.0)),
        *(Condition(search=search, sd=sd) for sd in (0.0, 2.0, 5.0)),
        Condition(search=search, chamfer=0.0),
    ]


class InsertionTrial(Record, frozen=True, kw_only=True):
    """One trial, with what came of it."""

    condition: int
    """Its number among those that were tried."""
    seed: int
    """Of its world."""
    number: int
    """Of the trial in that world, from 0."""
    error: tuple[float, float] = (0.0, 0.0)
    """Where the hole was, x and y against the pin's end, mm."""
    outcome: Literal["seated", "told", "silent"] = "told"
    """The pin is in its hole, and the program says so; it called the operator; it said done, and was wrong."""
    places: int = 0
    """Places tried."""
    peak: float = 0.0
    """Greatest force between pin and plate, N, by the truth of each physics step."""
    felt: float = 0.0
    """Greatest force that the hand felt, N."""
    seconds: float | None = None
    """From the first contact of pin and plate until the pin was seated, of the cell's clock; None: it never was."""
    whole: float = 0.0
    """Seconds of the cell's clock that all of it took."""
    told: str = ""
    """What the operator was told."""


class _Feeling(Observer):
    """Keeps the greatest force that the hand felt, N."""

    def __init__(self) -> None:
        self.most = 0.0

    def tick(self, period: ServoPeriod) -> None:
        if period.wrench is not None:
            self.most = max(self.most, float(np.linalg.norm(period.wrench[:3])))


def trials(conditions: Sequence[Condition], n: int, *, seed: int, workers: int) -> Iterator[InsertionTrial]:
    """So many trials of each condition, in the order they come; equal seeds give equal trials, however many workers.

    Raises:
        InvalidInput: there is no such hole, or no such world.
    """
    for condition in conditions:
        bench().variation(seed).check(WorldSpec(seed=seed, overrides=Overrides(set=condition.hole)))
    lasts = [
        InsertionTrial(condition=index, seed=seed + world, number=min(TRIALS_A_WORLD, n - first) - 1)
        for index in range(len(conditions))
        for world, first in enumerate(range(0, n, TRIALS_A_WORLD))
    ]
    work = partial(trials_in_world, tuple(conditions))
    found = map(work, lasts) if workers == 1 or len(lasts) == 1 else in_processes(work, lasts, workers)
    for share in found:
        yield from share


def trials_in_world(conditions: Sequence[Condition], last: InsertionTrial) -> list[InsertionTrial]:
    """The trials of a condition in a world, up to the last one."""
    condition = conditions[last.condition]
    begun = fetched(condition.plan, last.seed)
    return [tried(condition, begun, replace(last, number=number)) for number in range(last.number + 1)]


def fetched(plan: Plan, seed: int) -> Runner:
    """A run in the world of a seed that has come to where its second stage begins, or has stopped before."""
    world = WorldSpec(seed=seed, overrides=Overrides(set=Condition().hole))
    setup = Setup(plan=plan, world=world, camera="ray")
    runner = Runner(Checkpoint(setup=setup))
    while not runner.ended and runner.next is not None and runner.next.stage == 0:
        runner.step()
    return runner


def tried(
    condition: Condition, begun: Runner, trial: InsertionTrial, plan: Plan | None = None
) -> InsertionTrial:
    """A trial that goes on where the pin has been fetched, with its hole as far off as is drawn.

    Args:
        plan: carried out from there; by default that of the condition. Up to there it is as the one that fetched.
    """
    if begun.ended:
        return replace(trial, told=_told(begun))
    drawn = random_numbers(trial.seed, f"insertion.error.{trial.number}").standard_normal(2) * condition.sd
    trial = replace(trial, error=(round(float(drawn[0]), 6), round(float(drawn[1]), 6)))
    feeling = _Feeling()
    start = _beginning(condition, begun, trial, plan or condition.plan)
    runner = Runner(start, observers=lambda _: [feeling])
    began = runner.time
    advance(runner)
    return replace(_seen(trial, runner), felt=round(feeling.most, 6), whole=round(runner.time - began, 6))


def _seen(trial: InsertionTrial, runner: Runner) -> InsertionTrial:
    """What the witness says of a run that has ended, beside what the program says."""
    seen, done = bench().witnessed(runner.arm_cell), runner.call is None and runner.trouble is None
    return replace(
        trial,
        outcome=("seated" if seen.right else "silent") if done else "told",
        places=1 + sum(isinstance(event, SearchAdvanced) for event in runner.events),
        peak=round(seen.peak, 6),
        seconds=None if seen.seated is None or seen.first is None else round(seen.seated - seen.first, 6),
        told="" if done else _told(runner),
    )


def _beginning(condition: Condition, begun: Runner, trial: InsertionTrial, plan: Plan) -> Checkpoint:
    """The state in which a trial begins: that of what was fetched, with another plate and another noise.

    The plate is laid by where the pin's end truly is, so that the error is the drawn one and nothing else.
    """
    start = begun.checkpoint()
    assert start.snapshot is not None
    assert start.snapshot.cell is not None
    x, y = trial.error
    off = bench().off(begun.cell.truth, (x * MILLIMETRE, y * MILLIMETRE))
    world = WorldSpec(seed=trial.seed, overrides=Overrides(set=condition.hole | off))
    noise = noise_state(random_numbers(trial.seed, f"insertion.noise.{trial.number}"))
    return replace(
        start,
        setup=replace(start.setup, plan=plan, world=world),
        snapshot=replace(start.snapshot, cell=replace(start.snapshot.cell, noise=noise)),
    )


def _told(runner: Runner) -> str:
    """What the operator was told."""
    if runner.call is None:
        return runner.trouble or ""
    return call_sentence(runner.call.message, runner.call.error, runner.call.cause)


@cache
def _plan(search: Search, step: float) -> Plan:
    """The plan of a program of the bench, with a step of its search (in)."""
    file = plans() / bench().programs[search]
    written = read_source(file)
    source = Source(name=written.name, text=written.text.replace(_WRITTEN_STEP, f"SEARCH  {step:g}"))
    made = plan_source(source, taught_beside(file), bench().arm, AL, task=TASK)
    assert made.plan is not None, made.diagnostics
    return made.plan
