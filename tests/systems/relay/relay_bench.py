"""A short relay in the pump's cell: one program takes a pin, another one carries it on."""

from collections.abc import Callable
from pathlib import Path
from shutil import copy

from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.variation import WorldSpec
from handeye.program.events import OperatorCalled, to_line
from handeye.runs.checkpoint_file import decode, encode
from handeye.runs.folder import RunFolder
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.relay.plan import RelayPlan, made

TAKE = """
        STAGE   "go to the pin"
        OPEN    1
        MOVE    P1
        STAGE   "take the pin"
        CENTER  .1
        SAVE    C1
        CLOSE   0.1
        CHANGE  [0 0 1] 1.5
"""
CARRY = """
        STAGE   "carry it on"
        MOVE    T1
        RESTORE C1
        CLOSE   0.1             ;has it come along?
        SKIPN   2
        WAIT    "NO PIN"
        CHANGE  [0 0 1] .2
"""
RELAY = """
STAGE "go to the pin"  take.al
STAGE "take the pin"   take.al
STAGE "carry it on"    carry.al
"""


def pin_relay(folder: Path, relay: str = RELAY, **texts: str) -> RelayPlan:
    """The plan of a relay of the programs `take.al` and `carry.al`, or of other texts."""
    for name, text in {"take": TAKE, "carry": CARRY, **texts}.items():
        (folder / f"{name}.al").write_text(text, encoding="utf-8")
        copy(plans() / "water_pump.toml", folder / f"{name}.toml")
    return made(Source(name="pin.relay", text=relay), folder)


def start_of(plan: RelayPlan) -> Checkpoint:
    return Checkpoint(setup=Setup(system="relay", plan=plan, world=WorldSpec(seed=1), camera="ray"))


def runner_of(plan: RelayPlan) -> Runner:
    return Runner(start_of(plan))


def kept_in(folder: RunFolder, start: Checkpoint, *, again: bool) -> Runner:
    """A run whose record is kept in a folder; with `again`, it resumes there."""
    return Runner(start, observers=lambda runner: [folder.watch(runner, start, again=again)])


def on_disk(checkpoint: Checkpoint) -> Checkpoint:
    """A checkpoint as a later process reads it."""
    return decode(encode(checkpoint), "it")


def to_end(runner: Runner, before: Callable[[Runner], object] = lambda _: None) -> list[str]:
    """Run to the end, or to the call to the operator; returns all events as lines."""
    while not runner.ended:
        before(runner)
        runner.step()
    runner.finish()
    return [to_line(event).decode() for event in runner.events]


def call(runner: Runner) -> str:
    """What the run says to the operator in its last call."""
    return next(event.message for event in reversed(runner.events) if isinstance(event, OperatorCalled))
