"""The cost of runs: processor time by phase, stage and component, and in comparison with the physics alone."""

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
"""First word of a place; the second is the name of the stage."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Spent:
    """CPU seconds of one run, or of several, by place and component."""

    each: Mapping[tuple[Place, str], float]

    @classmethod
    def summed(cls, several: Iterable["Spent"]) -> "Spent":
        """Return the sum over several runs."""
        each: dict[tuple[Place, str], float] = {}
        for spent in several:
            for what, seconds in spent.each.items():
                each[what] = each.get(what, 0.0) + seconds
        return cls(each=each)

    @property
    def preparation_cpu_s(self) -> float:
        """Time of the preparation: building the cell, measuring the joints, and calibrating the camera."""
        return self._of(PREPARATION)

    @property
    def referee_cpu_s(self) -> float:
        """Time of the referee, and of making the result."""
        return self._of(REFEREE)

    @property
    def work_cpu_s(self) -> float:
        """Time of the working phase."""
        return sum(self.components().values())

    @property
    def pictures_cpu_s(self) -> float:
        """Part of the working phase in which pictures are made and analysed."""
        return sum(self.components()[component] for component in PICTURES)

    @property
    def cpu_s(self) -> float:
        """All processor time of the run."""
        return sum(self.each.values())

    def components(self, *stages: str) -> dict[str, float]:
        """Return the CPU s of each component in the working phase, or in some of its stages."""
        return self._by_component(lambda place: place[:1] == (STAGE,) and (not stages or place[1] in stages))

    def of_preparation(self) -> dict[str, float]:
        """Return the CPU s of each component in the preparation."""
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
    """The cost of one run."""

    result: Result
    spent: Spent
    account_cpu_s: float
    """Part of `spent` that the measuring itself took."""
    bare: Bare | None = None
    """The replay of the physics of its working phase."""

    @property
    def simulated_s(self) -> float:
        """Simulated duration of the working phase."""
        return self.result.timing.working_s

    @property
    def ratio(self) -> float | None:
        """Time of the working phase, divided by the time of its physics alone."""
        return None if self.bare is None else self.spent.work_cpu_s / self.bare.seconds

    @property
    def ratio_without_pictures(self) -> float | None:
        """The same ratio, without the time for pictures."""
        spent = self.spent
        return None if self.bare is None else (spent.work_cpu_s - spent.pictures_cpu_s) / self.bare.seconds


@dataclass(frozen=True, slots=True, kw_only=True)
class Speed:
    """The cost of a process that planned once, and executed the plan in some worlds."""

    start_cpu_s: float
    """Start of the interpreter, and imports."""
    planning_cpu_s: float
    stages: tuple[str, ...]
    runs: tuple[RunCost, ...]
    peak_memory_mib: float | None
    """Greatest memory of the process until the last world was judged; None if the operating system does not report
    it.
    """

    @property
    def spent(self) -> Spent:
        """The processor time in all worlds together."""
        return Spent.summed(run.spent for run in self.runs)

    @property
    def cpu_s(self) -> float:
        """Processor time of the whole process, without recording and replaying tapes."""
        return self.start_cpu_s + self.planning_cpu_s + self.spent.cpu_s

    @property
    def accepted(self) -> int:
        """Number of worlds in which the referee accepted the work."""
        return sum(run.result.assembled is True for run in self.runs)

    @property
    def accepted_per_core_hour(self) -> float:
        """Number of accepted pumps per hour of processor time."""
        return self.accepted / self.cpu_s * 3600

    @property
    def simulated_s_per_cpu_s(self) -> float:
        """Simulated seconds of the working phases per CPU second."""
        return sum(run.simulated_s for run in self.runs) / self.spent.work_cpu_s
