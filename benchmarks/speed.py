"""Where the processor time of whole runs goes, and what the same physics takes alone.

Every world is carried out with an account of its time. Then the work is done again from where it began, on tape and
without an account, and the tape is played: so neither recording nor playing is in the figures of the run.
"""

import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from benchmarks.bare_physics import Bare, play
from benchmarks.cpu_account import CpuAccount
from benchmarks.run_components import charged_to
from benchmarks.run_cost import PREPARATION, REFEREE, STAGE, RunCost, Speed, Spent
from benchmarks.tape import Tape
from handeye.program.events import AnyEvent, StageStarted
from handeye.results.finishing import outcome
from handeye.runs.advance import advance
from handeye.runs.folder import open_new
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint


@dataclass(slots=True)
class _Stages(Observer):
    """Charges each stage to itself; what is between two, to the one before."""

    account: CpuAccount

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StageStarted):
            self.account.at((STAGE, event.stage))


@dataclass(frozen=True, slots=True, kw_only=True)
class Watching:
    """The observer of all this."""

    observers: Sequence[Observer] = ()
    viewed: Callable[[int, int], None] = lambda *_: None
    """Told of each view in which the camera is calibrated: its number, of how many."""


NOBODY: Final = Watching()


def carry_out(
    setup: Setup, watching: Watching = NOBODY, *, folder: Path | None = None, calibrate: bool = True
) -> tuple[RunCost, Checkpoint]:
    """Run with an account of the time; what it has cost, and the state in which its work began.

    Args:
        folder: trace and checkpoints are kept there.
        calibrate: the camera is calibrated again, whatever is kept.

    Raises:
        InvalidInput: the run cannot be had.
    """
    account, start = CpuAccount(place=PREPARATION), Checkpoint(setup=setup)

    keeping = None if folder is None else open_new(folder, start)

    def observers(runner: Runner) -> Iterator[Observer]:
        yield _Stages(account)
        yield from watching.observers
        if keeping is not None:
            yield keeping.watch(runner, start, again=False)

    with charged_to(account):
        runner = Runner(
            start, viewed=watching.viewed, observers=lambda runner: [*observers(runner)], calibrate=calibrate
        )
        begun = runner.checkpoint()
        pause = advance(runner)
        runner.finish()
        if keeping is not None:
            keeping.close()
        account.at(REFEREE)
        result = outcome(runner, pause, Meter(), judged=True)
        account.close()
    spent = Spent(each=account.spent)
    return RunCost(result=result, spent=spent, account_cpu_s=account.own_s()), begun


def bare(begun: Checkpoint, watching: Watching = NOBODY) -> Bare:
    """Do the work of a run again from where it began, and then its physics alone."""
    runner = Runner(begun, observers=lambda _: watching.observers)
    tape = Tape(runner.arm_cell)
    with tape.recording():
        advance(runner)
    return play(tape, time.process_time)


def measure(
    setups: Sequence[Setup],
    stages: tuple[str, ...],
    *,
    start_cpu_s: float,
    planning_cpu_s: float,
    traced: bool = False,
    watching: Watching = NOBODY,
) -> Speed:
    """Carry out some runs, and then the physics of each alone.

    Args:
        traced: trace and checkpoints are kept, in a folder that is removed afterwards.

    Raises:
        InvalidInput: one of them cannot be had.
    """
    with tempfile.TemporaryDirectory(prefix="handeye-") as name:
        folders = [Path(name) / str(number) if traced else None for number in range(len(setups))]
        measured = [
            carry_out(setup, watching, folder=folder) for setup, folder in zip(setups, folders, strict=True)
        ]
    peak = peak_memory_mib()
    return Speed(
        start_cpu_s=start_cpu_s,
        planning_cpu_s=planning_cpu_s,
        stages=stages,
        runs=tuple(replace(run, bare=bare(begun, watching)) for run, begun in measured),
        peak_memory_mib=peak,
    )


def peak_memory_mib() -> float | None:
    """The most memory that this process has had, MiB; None in Windows, which is not asked."""
    if sys.platform == "win32":
        return None
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (2**20 if sys.platform == "darwin" else 2**10)
