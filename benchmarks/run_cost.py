"""What runs have cost: processor time by phase, stage and component, and beside their physics alone."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Final

from benchmarks.bare_physics import Bare
from benchmarks.cpu_account import Place
from benchmarks.run_components import COMPONENTS, PICTURES
from handeye.results.result import Result

PREPARATION: Final[Place] = ("preparation",)
REFEREE: Final[Place] = ("referee",)
STAGE: Final = "stage"
"""A place is this, and the name of the stage."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spent:
    """CPU seconds of one run, or of several, by place and component."""

    each: Mapping[tuple[Place, str], float]

    @classmethod
    def summed(cls, several: Iterable["Spent"]) -> "Spent":
        """Of several runs together."""
        each: dict[tuple[Place, str], float] = {}
        for spent in several:
            for what, seconds in spent.each.items():
                each[what] = each.get(what, 0.0) + seconds
        return cls(each=each)

    @property
    def preparation_cpu_s(self) -> float:
        """The cell built, joints and camera measured."""
        return self._of(PREPARATION)

    @property
    def referee_cpu_s(self) -> float:
        """The referee, and the result."""
        return self._of(REFEREE)

    @property
    def work_cpu_s(self) -> float:
        """The working phase."""
        return sum(self.components().values())

    @property
    def pictures_cpu_s(self) -> float:
        """The share of the working phase that pictures take, made and looked at."""
        return sum(self.components()[component] for component in PICTURES)

    @property
    def cpu_s(self) -> float:
        """All of it."""
        return sum(self.each.values())

    def components(self, *stages: str) -> dict[str, float]:
        """CPU s of the components in the working phase, or in some stages of it."""
        return self._by_component(lambda place: place[:1] == (STAGE,) and (not stages or place[1] in stages))

    def of_preparation(self) -> dict[str, float]:
        """CPU s of the components in the preparation."""
        return self._by_component(lambda place: place == PREPARATION)

    def _by_component(self, counts: Callable[[Place], bool]) -> dict[str, float]:
        found = dict.fromkeys(COMPONENTS, 0.0)
        for (place, component), seconds in self.each.items():
            if counts(place):
                found[component] += seconds
        return found

    def _of(self, place: Place) -> float:
        return sum(seconds for (where, _), seconds in self.each.items() if where == place)


@dataclass(frozen=True, slots=True, kw_only=True)
class RunCost:
    """What one run has cost."""

    result: Result
    spent: Spent
    account_cpu_s: float
    """What measuring took of that."""
    bare: Bare | None = None
    """The physics of its working phase, alone."""

    @property
    def simulated_s(self) -> float:
        """Of the working phase, by the cell's clock."""
        return self.result.timing.working_s

    @property
    def ratio(self) -> float | None:
        """Working phase to its physics alone."""
        return None if self.bare is None else self.spent.work_cpu_s / self.bare.seconds

    @property
    def ratio_without_pictures(self) -> float | None:
        """The same, what pictures take left out."""
        spent = self.spent
        return None if self.bare is None else (spent.work_cpu_s - spent.pictures_cpu_s) / self.bare.seconds


@dataclass(frozen=True, slots=True, kw_only=True)
class Speed:
    """What a process has cost that planned once and carried the plan out in some worlds."""

    start_cpu_s: float
    """The interpreter, and everything imported."""
    planning_cpu_s: float
    stages: tuple[str, ...]
    runs: tuple[RunCost, ...]
    peak_memory_mib: float | None
    """Of the process when the last world was judged; None: this system does not tell."""

    @property
    def spent(self) -> Spent:
        """Of all worlds."""
        return Spent.summed(run.spent for run in self.runs)

    @property
    def cpu_s(self) -> float:
        """The whole process, without the tapes."""
        return self.start_cpu_s + self.planning_cpu_s + self.spent.cpu_s

    @property
    def accepted(self) -> int:
        """Worlds in which the referee found everything right."""
        return sum(run.result.assembled is True for run in self.runs)

    @property
    def accepted_per_core_hour(self) -> float:
        """As many would be accepted in an hour of one processor."""
        return self.accepted / self.cpu_s * 3600

    @property
    def simulated_s_per_cpu_s(self) -> float:
        """Of the working phases."""
        return sum(run.simulated_s for run in self.runs) / self.spent.work_cpu_s
