"""Recorded runs of a small arm, for comparison. The arm grasps a block, lifts it, and puts it down."""

from pathlib import Path
from typing import Final

from block_task import block_plan

from handeye.core.variation import Overrides, WorldSpec
from handeye.report.recorded import RecordedRun
from handeye.runs.advance import advance
from handeye.runs.folder import TRACE, open_new
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trace.reading import read_trace

SCRIPT: Final = """TRANS ABOVE [20 24 1.2 90 90 0]
        STAGE   "reach"
        OPEN    2.4
        MOVE    ABOVE
        STOP    [0 0 -16]
        CHANGE  [0 0 -1] .4
        SKIPN   23
        OPEN    2.5
        STAGE   "grasp"
        CLOSE   .8
        CHANGE  [0 0 1] .2
"""


def kept(folder: Path, start: Checkpoint) -> RecordedRun:
    """Execute a run until it ends or stops, and keep it in a folder."""
    keeping = open_new(folder, start)
    runner = Runner(start, observers=lambda runner: [keeping.watch(runner, start, again=False)])
    advance(runner)
    runner.finish()
    keeping.close()
    return RecordedRun(trace=read_trace(folder / TRACE))


def block_start(script: str = SCRIPT, seed: int = 0, **values: float) -> Checkpoint:
    """Return a run of the small arm that has not begun, in a world with some quantities set (SI)."""
    world = WorldSpec(seed=seed, overrides=Overrides(set=values))
    setup = Setup(plan=block_plan(script), world=world, camera="ray")
    return Checkpoint(setup=setup)
