"""Measures the time that trace and checkpoints add to a run. All times are from the same run."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from handeye.execution.servo import ServoPeriod
from handeye.program.events import AnyEvent
from handeye.runs.advance import advance
from handeye.runs.folder import TRACE, RunFolder, open_new
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint


@dataclass(frozen=True, slots=True, kw_only=True)
class Overhead:
    """Wall-clock times (s) in one working phase."""

    run: float
    """The working phase without tracing and checkpoints."""
    tracing: float
    """Time to record events and servo periods, and to close the trace."""
    checkpoints: float
    kept: int
    """Number of checkpoints."""
    ticks: int
    trace_bytes: int


@dataclass(slots=True)
class _Timed(Observer):
    """Passes everything to the folder of the run, and measures the time that the folder takes."""

    folder: RunFolder
    tracing: float = 0.0
    checkpoints: float = 0.0
    kept: int = 0
    ticks: int = 0
    begun: float = field(default_factory=time.perf_counter)

    def event(self, event: AnyEvent) -> None:
        with self._traced():
            self.folder.event(event)

    def tick(self, period: ServoPeriod) -> None:
        self.ticks += 1
        with self._traced():
            self.folder.tick(period)

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        begun = time.perf_counter()
        self.folder.checkpoint(checkpoint)
        self.checkpoints += time.perf_counter() - begun
        self.kept += 1

    def close(self) -> None:
        with self._traced():
            self.folder.close()

    @contextmanager
    def _traced(self) -> Iterator[None]:
        begun = time.perf_counter()
        yield
        self.tracing += time.perf_counter() - begun


def measure(setup: Setup, folder: Path) -> Overhead:
    """Execute a plan once, with trace and checkpoints in `folder`, and measure the times."""
    start = Checkpoint(setup=setup)
    keeping = open_new(folder, start)
    runner = Runner(start, observers=lambda runner: [_Timed(keeping.watch(runner, start, again=False))])
    (timed,) = runner.observers
    assert isinstance(timed, _Timed)
    advance(runner)
    runner.finish()
    timed.close()
    whole = time.perf_counter() - timed.begun
    return Overhead(
        run=whole - timed.tracing - timed.checkpoints,
        tracing=timed.tracing,
        checkpoints=timed.checkpoints,
        kept=timed.kept,
        ticks=timed.ticks,
        trace_bytes=(folder / TRACE).stat().st_size,
    )
