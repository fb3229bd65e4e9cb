"""Where the processor time of whole runs goes, and what the same physics takes alone.

Every world is carried out with an account of its time. Then the work is done again from where it began, on tape and
without an account, and the tape is played: so neither recording nor playing is in the figures of the run.
"""

import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from handeye.cell.tape import Bare, Tape
from handeye.events import AnyEvent, StageStarted
from handeye.report.finishing import outcome
from handeye.report.result import Result
from handeye.runs.advance import advance
from handeye.runs.folder import open_new
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trials.cpu_account import CpuAccount, Place
from handeye.trials.run_components import COMPONENTS, PICTURES, charged_to

PREPARATION: Final[Place] = ("preparation",)
REFEREE: Final[Place] = ("referee",)
_STAGE: Final = "stage"


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
        return {
            component: sum(
                seconds
                for (place, of), seconds in self.each.items()
                if of == component and place[:1] == (_STAGE,) and (not stages or place[1] in stages)
            )
            for component in COMPONENTS
        }

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
        """The whole process, but for the tapes."""
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


@dataclass(slots=True)
class _Stages(Observer):
    """Charges each stage to itself; what is between two, to the one before."""

    account: CpuAccount

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StageStarted):
            self.account.at((_STAGE, event.stage))


@dataclass(frozen=True, slots=True, kw_only=True)
class Watching:
    """Who looks on while all this goes on."""

    observers: Sequence[Observer] = ()
    viewed: Callable[[int, int], None] = lambda *_: None
    """Told of each view in which the camera is calibrated: its number, of how many."""


def carry_out(
    setup: Setup, watching: Watching, *, traced: bool = False, calibrate: bool = True
) -> tuple[RunCost, Checkpoint]:
    """Carry out a run with an account of its time; what it has cost, and the state in which its work began.

    Args:
        traced: trace and checkpoints are kept, in a folder that is removed afterwards.
        calibrate: the camera is calibrated anew, whatever is kept.

    Raises:
        InvalidInput: the run cannot be had.
    """
    account, start = CpuAccount(place=PREPARATION), Checkpoint(setup=setup)

    def observers(runner: Runner) -> Iterator[Observer]:
        yield _Stages(account)
        yield from watching.observers
        if folder is not None:
            yield folder.watch(runner, start, again=False)

    with ExitStack() as stack:
        place = stack.enter_context(tempfile.TemporaryDirectory(prefix="handeye-")) if traced else None
        folder = None if place is None else open_new(Path(place) / "run", start)
        stack.enter_context(charged_to(account))
        runner = Runner(
            start, viewed=watching.viewed, observers=lambda runner: [*observers(runner)], calibrate=calibrate
        )
        begun = runner.checkpoint()
        pause = advance(runner)
        runner.finish()
        if folder is not None:
            folder.close()
        account.at(REFEREE)
        result = outcome(runner, pause, Meter(), judged=True)
        account.close()
    spent = Spent(each=account.spent)
    return RunCost(result=result, spent=spent, account_cpu_s=account.own_s()), begun


def bare(begun: Checkpoint, watching: Watching) -> Bare:
    """Do the work of a run again from where it began, and then its physics alone."""
    runner = Runner(begun, observers=lambda _: watching.observers)
    tape = Tape(runner.cell)
    with tape.recording():
        advance(runner)
    return tape.play(time.process_time)


def measure(
    setups: Sequence[Setup],
    stages: tuple[str, ...],
    *,
    start_cpu_s: float,
    planning_cpu_s: float,
    traced: bool = False,
    watching: Watching | None = None,
) -> Speed:
    """Carry out some runs, and then the physics of each alone.

    Raises:
        InvalidInput: one of them cannot be had.
    """
    looking_on = watching or Watching()
    measured = [carry_out(setup, looking_on, traced=traced) for setup in setups]
    peak = peak_memory_mib()
    return Speed(
        start_cpu_s=start_cpu_s,
        planning_cpu_s=planning_cpu_s,
        stages=stages,
        runs=tuple(replace(run, bare=bare(begun, looking_on)) for run, begun in measured),
        peak_memory_mib=peak,
    )


def peak_memory_mib() -> float | None:
    """The most memory that this process has had, MiB; None in Windows, which is not asked."""
    if sys.platform == "win32":
        return None
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (2**20 if sys.platform == "darwin" else 2**10)
