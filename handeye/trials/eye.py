"""Trials that run no program, such as those of vision. Several attempts are made in each world."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import msgspec

from handeye.core.variation import WorldSpec
from handeye.tasks import task
from handeye.tasks.trial import Attempt, Known, Trial
from handeye.trials.sweep import Case, Sweep, TrialRow


class EyeRow(TrialRow, frozen=True, kw_only=True):
    """One attempt of a trial."""

    attempt: dict[str, Any] = msgspec.field(default_factory=dict)
    """The values of the attempt. The keys are the field names of the class that describes the attempts of this trial.
    """
    came: str = "missed"
    told: str = ""

    @property
    def outcome(self) -> str:
        return self.came

    @property
    def detail(self) -> str:
        return super().detail if self.broken_off else self.told


EYE: Final = Sweep(
    kind="eye",
    row=EyeRow,
    outcomes={"right": "right", "missed": "wrong", "wrong": "silent"},
    success="right",
    noun="attempt",
    sentence=lambda row: f"seed {row.seed:4}  {row.detail}",
    shared_worlds=True,
)
"""A sweep of attempts in many worlds. `eye_sweep` adds what depends on the trial: its name, its figures and its
summary.
"""


def eye_sweep(name: str, trial: Trial[Any]) -> Sweep[EyeRow]:
    """Return the sweep for `trial`. `name` is the name of this trial in the list of its task."""

    def attempts(rows: Sequence[EyeRow]) -> list[Attempt]:
        found = [msgspec.convert(row.attempt, trial.attempt) for row in rows if row.attempt]
        return sorted(found, key=lambda each: (each.seed, each.number))

    def more(rows: Sequence[EyeRow]) -> dict[str, object]:
        known = attempts(rows)
        figures = trial.count(known).figures if known else {}
        cpu_s = sum(row.cpu_s for row in rows) / len(rows) if rows else 0.0
        return {"trial": name, **figures, "cpu_s_each": cpu_s, "attempts": known}

    def summary(rows: Sequence[EyeRow]) -> list[str]:
        known = attempts(rows)
        lines = trial.count(known).lines if known else ()
        return [*lines, f"{sum(row.cpu_s for row in rows) / max(1, len(rows)):.1f} CPU seconds per attempt"]

    return replace(EYE, kind=f"eye {name}", more=more, summary=summary)


@dataclass(frozen=True, slots=True, kw_only=True)
class EyeWork:
    """Makes the attempts of a trial that runs no program. All attempts of one case share a world and its camera
    calibration.
    """

    task: str
    trial: str
    world: WorldSpec  # World of every case, without its seed
    camera: str
    known: Known

    def __call__(self, case: Case) -> list[EyeRow]:
        """Make the attempts of a case."""
        trial: Any = task(self.task).trials[self.trial]
        world = msgspec.structs.replace(self.world, seed=case.seed)
        attempts = trial.attempts(world, len(case.trials), camera=self.camera, known=self.known)
        return [
            EyeRow(
                trial=number, seed=case.seed, attempt=msgspec.to_builtins(attempt), came=trial.outcome(attempt),
                told=trial.sentence(attempt),
            )
            for number, attempt in zip(case.trials, attempts, strict=True)
        ]  # fmt: skip


def eye_cases(seed: int, number: int, worlds: int) -> list[Case]:
    """Distribute attempts evenly over worlds. Attempt k is made in the world of `seed` + k % `worlds`."""
    return [Case(trials=tuple(range(k, number, worlds)), seed=seed + k) for k in range(min(number, worlds))]
