"""Measures the processor time of whole runs by component, and the time of the same physics alone.

Each world is first run with an account of its time. Then the work is repeated from its beginning without an account,
and recorded on a tape, and the tape is replayed. The figures of the run therefore include neither recording nor replay.
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
    """Counts time for the present stage. The time between two stages counts for the earlier one."""

    account: CpuAccount

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, StageStarted):
            self.account.at((STAGE, event.stage))


@dataclass(frozen=True, slots=True, kw_only=True)
class Watching:
    """Observers of the measured runs."""

    observers: Sequence[Observer] = ()
    viewed: Callable[[int, int], None] = lambda *_: None
    """Called for each view of a camera calibration, with the number of the view and the total number of views."""


NOBODY: Final = Watching()


def carry_out(
    setup: Setup, watching: Watching = NOBODY, *, folder: Path | None = None, calibrate: bool = True
) -> tuple[RunCost, Checkpoint]:
    """Execute a run with an account of its time. Returns its cost, and the state in which its work began.

    Args:
        folder: folder for trace and checkpoints; None: they are not written.
        calibrate: calibrate the camera even if an earlier run stored its calibration.

    Raises:
        InvalidInput: the run is impossible.
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
    """Repeat and record the work of a run from the state in which it began, and then replay its physics alone."""
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
    """Execute some runs, and then replay the physics of each alone.

    Args:
        traced: write trace and checkpoints, into a folder that is removed afterwards.

    Raises:
        InvalidInput: one of the runs is impossible.
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
    """Return the greatest memory of this process so far (MiB); None on Windows, where it is not measured."""
    if sys.platform == "win32":
        return None
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (2**20 if sys.platform == "darwin" else 2**10)
