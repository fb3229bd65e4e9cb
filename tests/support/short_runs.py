"""Short programs as plans, and their runs. They take no pictures, so no camera must be calibrated."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

from handeye.al import compile_text, sewn_of
from handeye.arm.robots.stanford import STANFORD
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.planning.planner import make_plan
from handeye.program.events import AnyEvent, to_line
from handeye.program.taught import load_taught
from handeye.runs.folder import TRACE, open_new
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace

GRASP = """
        STAGE   "go to the pin"
        OPEN    1
        MOVE    P1
        STAGE   "take the pin"
        CENTER  .1
        SAVE    C1              ;where the holder really is
        CLOSE   0.1             ;grasp it
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        STAGE   "feel for nothing"
        SEARCH  .07
AGAIN:  STOP    [0 0 -50]
        CHANGE  [0 0 -1] .3
        SKIPN   23
        JUMP    DONE
        AOJ     AGAIN
DONE:   OPEN    1
"""
"""Takes a pin out of its holder and meets no resistance in the air: error 23, tested."""

FEEL = """
TRANS   ABOVE [25 38 .5 90 90 0]
        STAGE   "feel"
        MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 1 .5   ;stops on the table
        STOP    [0 0 40]
        CHANGE  [0 0 1] .2      ;meets nothing
        SKIPE   23
        OPEN    1
"""
"""Feels for the table, and then feels in a place where there is nothing."""


@cache
def plan_of(script: str, files: tuple[tuple[str, str], ...] = ()) -> Plan:
    """The plan of a script and the files it requires, with the taught positions of the water pump."""
    taught = load_taught(plans() / "water_pump.toml")
    program, diagnostics = compile_text(sewn_of(Source(name="short.al", text=script), dict(files)), taught)
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert plan is not None, problems
    return plan


def begin(script: str = GRASP, seed: int = 0, files: tuple[tuple[str, str], ...] = ()) -> Checkpoint:
    """A run that has not begun."""
    return Checkpoint(setup=Setup(plan=plan_of(script, files), world=WorldSpec(seed=seed), camera="ray"))


def through(runner: Runner) -> Runner:
    """Execute a run to its end."""
    while not runner.ended:
        runner.step()
    return runner


def traced(start: Checkpoint, path: Path, *, prepare: Callable[[Runner], None] = lambda _: None) -> Trace:
    """Execute a run in a folder, and return its trace. `prepare` may change the run before it begins."""
    folder = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    prepare(runner)
    through(runner).finish()
    folder.close()
    return read_trace(path / TRACE)


def history(events: list[AnyEvent]) -> bytes:
    """Everything that happened, as bytes."""
    return b"".join(to_line(event) for event in events)
