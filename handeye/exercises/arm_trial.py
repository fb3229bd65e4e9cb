"""Runs a student's program for the arm in one world of an exercise, and judges it."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Final, Self

import msgspec

from handeye.core.variation import Overrides, WorldSpec
from handeye.exercises.exercise import Standing, Verdict
from handeye.judge.finding import at_most
from handeye.report.facts.again import world_words
from handeye.results.result import Check
from handeye.tasks import task
from handeye.trials.assembly import FinishedRun, run_plan
from handeye.trials.insertion import bench
from handeye.trials.plans.trial import Watch
from handeye.trials.sweep import Case, Sweep, TrialRow

if TYPE_CHECKING:
    from handeye.planfile.plan import Plan

SIMULATED_LIMIT_S: Final = 600.0  # the longest search of the bench, or two pictures of a part, take 90 s
CPU_LIMIT_S: Final = 120.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmWorlds:
    """Worlds of an exercise, and what a right program does in them."""

    seeds: range
    told: str  # what these worlds have in common, in words that follow a number
    set: Mapping[str, float] = field(default_factory=dict)  # quantities with fixed values, SI
    faults: tuple[str, ...] = ()  # names of faults, each of its usual size
    calls: bool = False  # the work is impossible, so a right program calls the operator

    def moved(self, by: int) -> Self:
        """Return worlds of the same kind, whose seeds are larger by `by`."""
        return replace(self, seeds=range(self.seeds.start + by, self.seeds.stop + by))


class ArmRow(TrialRow, frozen=True, kw_only=True):
    """The trial of one world."""

    found: Verdict | None = None  # None: the trial did not finish

    @property
    def outcome(self) -> str:
        assert self.found is not None
        return self.found.standing


ARM_SWEEP: Final = Sweep(
    kind="exercise",
    row=ArmRow,
    outcomes={"right": "right", "wrong": "wrong", "silent": "silent"},
    success="right",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmTrial:
    """Runs a plan in the worlds of an exercise."""

    plan: Plan
    file: str  # of the program
    task: str
    worlds: tuple[ArmWorlds, ...]
    referee: str | None  # one of the task's other referees, which judges the work instead of the usual one
    most_force: float | None  # limit of the force between pin and plate in any physics step, N

    def __call__(self, case: Case) -> list[ArmRow]:
        """Run and judge the plan in the world of a case."""
        watch = Watch(simulated_s=SIMULATED_LIMIT_S, cpu_s=CPU_LIMIT_S)
        done = run_plan(
            self.plan,
            world=self._world(case.seed),
            camera="ray",
            observers=watch.looking_on,
            halt=watch.over,
            own_referee=None if self.referee is None else task(self.task).referees[self.referee],
        )
        (number,) = case.trials
        if watch.ended != "ended":
            return [ArmRow(trial=number, seed=case.seed, ended=watch.ended)]
        return [ArmRow(trial=number, seed=case.seed, found=self._verdict(case.seed, done))]

    def verdict(self, row: ArmRow) -> Verdict:
        """Return the verdict on the trial of a row. A trial that did not finish also gets a verdict."""
        return row.found or self._told(row.seed, "wrong", "did not end", row.detail)

    def _verdict(self, seed: int, done: FinishedRun) -> Verdict:
        result, impossible = done.result, self._of(seed).calls
        if not result.completed:
            standing: Standing = "right" if impossible else "wrong"
            return self._told(seed, standing, "called the operator", result.message, result.error)
        rejected = "; ".join(check.told for check in result.checks if check.refuses)
        if rejected or impossible:
            return self._told(seed, "silent", "reported success, but the work is wrong", rejected)
        force = self._force(done)
        if force is not None and force.refuses:
            return self._told(seed, "wrong", "pressed too hard", force.told)
        return self._told(seed, "right", "accepted", "")

    def _force(self, done: FinishedRun) -> Check | None:
        if self.most_force is None:
            return None
        peak = bench().witnessed(done.runner.arm_cell).peak
        return Check.of(at_most(peak, self.most_force, "N", "greatest force between pin and plate"))

    def _told(
        self, seed: int, standing: Standing, outcome: str, reason: str, error: int | None = None
    ) -> Verdict:
        return Verdict(
            case=f"seed {seed}",
            standing=standing,
            outcome=outcome,
            reason=reason,
            error=error,
            again=self._again(seed),
        )

    def _again(self, seed: int) -> str:
        """Return the command that runs the program in the world of a seed, and saves the run for the report."""
        words = ["run", self.file, "--task", self.task, *world_words(self._world(seed), self.task)]
        return shlex.join(["handeye", *words, "--out", f"seed{seed}"])

    def _world(self, seed: int) -> WorldSpec:
        worlds = self._of(seed)
        world = WorldSpec(seed=seed, overrides=Overrides(set=dict(worlds.set)))
        known = task(self.task).faults(world)
        return msgspec.structs.replace(
            world, faults=tuple(known.kind(name).usual() for name in worlds.faults)
        )

    def _of(self, seed: int) -> ArmWorlds:
        return next(each for each in self.worlds if seed in each.seeds)
