"""The insertion bench: inserts one pin into one hole, in many worlds and with many position errors of the hole.

A trial begins when the hand holds the pin above the hole. The trial consists of search, insertion and check. The pin
is fetched once per world. Several trials start from the state in which the hand holds this pin, each with a different
position error of the hole.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Final, Literal

import numpy as np
from msgspec.structs import replace

from handeye.al import AL
from handeye.cell.state import noise_state
from handeye.core.distributions import random_numbers
from handeye.core.record import Record
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.core.units import INCH, MILLIMETRE
from handeye.core.variation import Overrides, WorldSpec
from handeye.execution.servo import ServoPeriod
from handeye.planfile.plan import Plan
from handeye.planning.planner import plan_source
from handeye.program.diagnosis.cause_text import call_sentence
from handeye.program.events import SearchAdvanced
from handeye.runs.advance import advance
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.scripts import taught_beside
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.tasks.inserting import CHAMFER, CLEARANCE, SPREAD, InsertionTask
from handeye.trials.sweep import Case, Details, Sweep, TrialRow

Search = Literal["gentle", "1973"]
TASK: Final = "insertion"
TRIALS_A_WORLD: Final = 10  # Trials for which the pin is fetched once; fetching takes a second of CPU time
_WRITTEN_STEP: Final = "SEARCH  .07"
_STEP_SHARE: Final = 0.92
"""The search step as a fraction of the greatest step with which every hole is found. For the hole of the Factory
benchmark, this gives a step of .07 in.
"""
_PLACE: Final = 0.005  # in; the search step is rounded down to a multiple of this


def bench() -> InsertionTask:
    """Return the task of the insertion bench."""
    found = task(TASK)
    assert isinstance(found, InsertionTask)
    return found


class Condition(Record, frozen=True, kw_only=True):
    """The condition of a trial: the hole, the spread of the hole's position error, and the kind of search."""

    clearance: float = CLEARANCE  # Clearance of the hole in diameter, mm
    chamfer: float = CHAMFER  # mm
    sd: float = SPREAD  # Standard deviation of the hole's position error along x and along y, mm
    search: Search = "gentle"

    @property
    def name(self) -> str:
        """The name of the condition for display."""
        search = "" if self.search == "gentle" else f", {self.search}"
        return f"{self.clearance:g} mm, chamfer {self.chamfer:g}, sd {self.sd:g}{search}"

    @property
    def step(self) -> float:
        """Distance between neighbouring search places (inches). The distance is chosen so that the pin still enters
        the hole from the worst point between four places."""
        caught = bench().caught(self.clearance * MILLIMETRE, self.chamfer * MILLIMETRE)
        return max(1, math.floor(_STEP_SHARE * math.sqrt(2) * caught / INCH / _PLACE)) * _PLACE

    @property
    def hole(self) -> dict[str, float]:
        """The quantities of a world in which the hole of this condition is at its taught position."""
        return bench().hole(self.clearance * MILLIMETRE, self.chamfer * MILLIMETRE)

    @property
    def plan(self) -> Plan:
        """The plan that the trial executes."""
        return _plan(self.search, self.step)


def grid(search: Search) -> list[Condition]:
    """Return the conditions to try. The first condition is the setting of the Factory benchmark; each further
    condition differs from the first in one value.
    """
    return [
        Condition(search=search),
        *(Condition(search=search, clearance=clearance) for clearance in (0.05, 0.3, 1.0)),
        *(Condition(search=search, sd=sd) for sd in (0.0, 2.0, 5.0)),
        Condition(search=search, chamfer=0.0),
    ]


class InsertionTrial(Record, frozen=True, kw_only=True):
    """The result of one trial."""

    seed: int
    number: int  # Number of the trial in that world, from 0
    error: tuple[float, float] = (0.0, 0.0)  # Position of the hole, x and y relative to the pin's end, mm
    outcome: Literal["seated", "told", "silent"] = "told"
    """`seated`: the pin is in its hole, and the program says so; `told`: the program called the operator; `silent`:
    the program reported success, but the pin is not in its hole.
    """
    places: int = 0
    peak: float = 0.0  # Greatest true force between pin and plate in any physics step, N
    felt: float = 0.0  # Greatest force that the hand felt, N
    seconds: float | None = None
    """Time on the cell's clock (s) from the first contact of pin and plate until the pin was seated; None if the pin
    was never seated.
    """
    whole: float = 0.0  # Duration of the whole trial, s on the cell's clock
    told: str = ""


class _ForcePeak(Observer):
    """Records the greatest force that the hand senses (N)."""

    def __init__(self) -> None:
        self.most = 0.0

    def tick(self, period: ServoPeriod) -> None:
        if period.wrench is not None:
            self.most = max(self.most, float(np.linalg.norm(period.wrench[:3])))


class InsertionRow(TrialRow, frozen=True, kw_only=True):
    """One trial under a condition. Ten trials share a world, in which the pin is fetched once."""

    tried: InsertionTrial | None = None  # None: it did not finish
    step_in: float = 0.0  # Step of the search

    @property
    def outcome(self) -> str:
        assert self.tried is not None
        return self.tried.outcome

    @property
    def detail(self) -> str:
        return super().detail if self.tried is None else self.tried.told

    @property
    def measures(self) -> Mapping[str, float]:
        each = self.tried
        if each is None:
            return {}
        seated = each.outcome == "seated" and each.seconds is not None
        times = {"contact to seated, s": each.seconds, "places": float(each.places)} if seated else {}
        return {"peak, N": each.peak, "felt, N": each.felt, "whole, s": each.whole, **times}  # type: ignore[dict-item]

    @property
    def facts(self) -> Mapping[str, float]:
        each = self.tried
        return {} if each is None else {"error_x, mm": each.error[0], "error_y, mm": each.error[1]}


@dataclass(frozen=True, slots=True, kw_only=True)
class InsertionWork:
    """Executes the trials of a case. The case gives the name of its condition."""

    conditions: Mapping[str, Condition]

    def __call__(self, case: Case) -> list[InsertionRow]:
        """Fetch the pin once. Begin every trial of the case in the state in which the hand holds the pin."""
        condition = self.conditions[case.condition]
        last = InsertionTrial(seed=case.seed, number=len(case.trials) - 1)
        found = zip(case.trials, trials_in_world(condition, last), strict=True)
        return [
            InsertionRow(
                trial=number,
                seed=case.seed,
                condition=case.condition,
                tried=tried,
                step_in=round(condition.step, 3),
            )
            for number, tried in found
        ]


def insertion_cases(conditions: Sequence[Condition], n: int, seed: int) -> list[Case]:
    """Return the cases with `n` trials of each condition, ten trials per world. The seeds of the worlds count up from
    `seed`. Raises InvalidInput if a condition is impossible.
    """
    for condition in conditions:
        bench().variation().check(WorldSpec(seed=seed, overrides=Overrides(set=condition.hole)))
    return [
        Case(
            trials=tuple(range(first, min(first + TRIALS_A_WORLD, n))),
            seed=seed + first // TRIALS_A_WORLD,
            condition=condition.name,
        )
        for condition in conditions
        for first in range(0, n, TRIALS_A_WORLD)
    ]


def trials_in_world(condition: Condition, last: InsertionTrial) -> list[InsertionTrial]:
    """Execute the trials of a condition in one world, from trial 0 to the trial `last`."""
    begun = fetched(condition.plan, last.seed)
    return [tried(condition, begun, replace(last, number=number)) for number in range(last.number + 1)]


def fetched(plan: Plan, seed: int) -> Runner:
    """Begin a run in the world of a seed, and stop when the second stage of the run begins. The hand then holds the
    pin. The run may also stop before its second stage.
    """
    world = WorldSpec(seed=seed, overrides=Overrides(set=Condition().hole))
    setup = Setup(plan=plan, world=world, camera="ray")
    runner = Runner(Checkpoint(setup=setup))
    while not runner.ended and runner.next is not None and runner.next.stage == 0:
        runner.step()
    return runner


def tried(
    condition: Condition, begun: Runner, trial: InsertionTrial, plan: Plan | None = None
) -> InsertionTrial:
    """Execute a trial from the state in which the hand holds the pin. The plan must have the same first stage
    as the plan of the condition."""
    if begun.ended:
        return replace(trial, told=_told(begun))
    drawn = random_numbers(trial.seed, f"insertion.error.{trial.number}").standard_normal(2) * condition.sd
    trial = replace(trial, error=(round(float(drawn[0]), 6), round(float(drawn[1]), 6)))
    feeling = _ForcePeak()
    start = _beginning(condition, begun, trial, plan or condition.plan)
    runner = Runner(start, observers=lambda _: [feeling])
    began = runner.time
    advance(runner)
    return replace(_seen(trial, runner), felt=round(feeling.most, 6), whole=round(runner.time - began, 6))


def _seen(trial: InsertionTrial, runner: Runner) -> InsertionTrial:
    """Complete the trial with what the witness recorded and what the program reported."""
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
    """Return the start of a trial: the state in which the hand holds the pin, with the plate and the noise of
    this trial.

    The plate is placed relative to the true position of the pin's end. The position error is therefore exactly the
    error of the trial.
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
    """Return the text with which the program called the operator."""
    if runner.call is None:
        return runner.trouble or ""
    return call_sentence(runner.call.message, runner.call.error, runner.call.cause)


@cache
def _plan(search: Search, step: float) -> Plan:
    """Plan the bench's program for the kind of search `search`, with the search step `step` (inches)."""
    file = plans() / bench().programs[search]
    written = read_source(file)
    source = Source(name=written.name, text=written.text.replace(_WRITTEN_STEP, f"SEARCH  {step:g}"))
    made = plan_source(source, taught_beside(file), bench().arm, AL, task=TASK)
    assert made.plan is not None, made.diagnostics
    return made.plan


GENTLE: Final = 20.0  # N; an insertion with a greater peak is not gentle


class Setting(Record, frozen=True, kw_only=True):
    """A condition with its search step, its number of trials, and the number of trials whose peak force was at most 20
    N.
    """

    condition: str
    step_in: float | None  # Step of the search
    n: int
    gentle: int  # Trials in which the peak was at most 20 N


def _settings(rows: Sequence[InsertionRow]) -> list[Setting]:
    found = []
    for name in dict.fromkeys(row.condition for row in rows):
        mine = [(row.step_in, row.tried.peak) for row in rows if row.condition == name and row.tried]
        gentle = sum(peak <= GENTLE for _, peak in mine)
        step_in = max((step for step, _ in mine), default=None)
        found.append(Setting(condition=name, step_in=step_in, n=len(mine), gentle=gentle))
    return found


def _details(rows: Sequence[InsertionRow]) -> tuple[Details, ...]:
    heads = ("hole, mm", "step, in", "trials", "peak at most 20 N")
    return (Details(name="settings", title="Settings of the hole", rows=_settings(rows), heads=heads),)


INSERTION: Final = Sweep(
    kind="insertion",
    row=InsertionRow,
    outcomes={"seated": "right", "silent": "silent", "told": "wrong"},
    success="seated",
    noun="insertion",
    details=_details,
    summary=lambda _: [
        "A hole is given by its diametral clearance, its chamfer, and the standard deviation of its position "
        "along each axis. Column `peak` is the largest contact force in any physics step, taken from the "
        "simulator; column `felt` is the largest force that the hand's sensor measured. Times are simulated."
    ],
    shared_worlds=True,
)
