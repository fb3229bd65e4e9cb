"""Runs of jobs with a fault. Some faults keep a program from ever ending."""

from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint


def judged_run(setup: Setup, longest: float) -> tuple[Runner, Result | None]:
    """Run a job and let its referee judge the work. The result is None if the program is still running after `longest`
    seconds of simulated time.
    """
    runner = Runner(Checkpoint(setup=setup))
    pause = advance(runner, steps=1)
    while pause.kind == "break" and runner.time < longest:
        pause = advance(runner, steps=200)
    return runner, None if pause.kind == "break" else finished(runner, pause, Meter(), judged=True)
