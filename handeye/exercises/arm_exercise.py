"""Defines exercises in which programs of the arm language are judged in worlds with fixed seeds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Self

from handeye.al import AL
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.exercises.arm_trial import ARM_SWEEP, ArmTrial, ArmWorlds
from handeye.exercises.exercise import Exercise, Submission, Verdict
from handeye.program.taught import Taught, read_taught
from handeye.runs.scripts import planned
from handeye.tasks import task
from handeye.trials.sweep import Case, carry_out, processes

if TYPE_CHECKING:
    from handeye.core.diagnostics import Diagnostic
    from handeye.planning.planner import PlannedScript


@dataclass(frozen=True, slots=True, kw_only=True)
class ArmExercise(Exercise):
    """An exercise in which a program moves the arm in the cell of a task."""

    task: str
    taught: str  # file among the plans, with the positions and parts that a program may use
    worlds: tuple[ArmWorlds, ...]
    referee: str | None = (
        None  # one of the task's other referees, which judges the work instead of the usual one
    )
    most_force: float | None = None  # limit of the force between pin and plate in any physics step, N

    @property
    def positions(self) -> Source:
        return read_source(plans() / self.taught)

    @property
    def seeds(self) -> tuple[int, ...]:
        return tuple(seed for each in self.worlds for seed in each.seeds)

    def beginning_at(self, first: int) -> Self:
        return replace(self, worlds=tuple(each.moved(first - min(self.seeds)) for each in self.worlds))

    @property
    def cases(self) -> str:
        parts = [
            f"{len(each.seeds)} {each.told} (seeds {each.seeds[0]} to {each.seeds[-1]})"
            for each in self.worlds
        ]
        *others, last = parts
        return f"{', '.join(others)} and {last}" if others else last

    @property
    def rules(self) -> tuple[str, ...]:
        names = ", ".join(read_taught(self.positions).positions)
        found = [f"The program uses only these taught positions, and does not change them: {names}."]
        if self.most_force is not None:
            found.append(
                f"The force between pin and plate is at most {self.most_force:g} N in each physics step."
            )
        return tuple(found)

    def diagnostics(self, given: Submission) -> list[Diagnostic]:
        return self._planned(given.source).diagnostics

    def broken_rules(self, given: Submission) -> list[str]:
        known = read_taught(self.positions).positions
        plan = self._planned(given.source).plan
        assert plan is not None, "the program was checked before"
        own = [name for name in plan.program.positions if name not in known]
        found = [f"the program defines the position {name}" for name in own]
        changed = plan.program.written("position") & set(known)
        found += [f"the program changes the taught position {name}" for name in sorted(changed)]
        if given.taught is not None and self._changed(read_taught(given.taught)):
            found.append(f"{given.taught.name} does not have the taught positions of the exercise")
        return found

    def verdicts(self, given: Submission) -> list[Verdict]:
        plan = self._planned(given.source).plan
        assert plan is not None, "the program was checked before"
        trial = ArmTrial(
            plan=plan,
            file=given.source.name,
            task=self.task,
            worlds=self.worlds,
            referee=self.referee,
            most_force=self.most_force,
        )
        cases = [Case(trials=(number,), seed=seed) for number, seed in enumerate(given.seeds or self.seeds)]
        rows = carry_out(
            ARM_SWEEP,
            trial,
            cases,
            processes(given.jobs),
            told=lambda row: given.told(trial.verdict(row)),
        )
        return [trial.verdict(row) for row in rows]

    def _read(self, file: Path) -> Source:
        return AL.read(file)

    def _planned(self, source: Source) -> PlannedScript:
        return planned(source, read_taught(self.positions), task(self.task), AL)

    def _changed(self, own: Taught) -> bool:
        known = read_taught(self.positions)
        return (own.positions, own.parts) != (known.positions, known.parts)
