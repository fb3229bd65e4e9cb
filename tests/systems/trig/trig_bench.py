"""TRIG sessions for tests with physics: the Purbrick arm, and a desk at which a text sits."""

from collections.abc import Callable
from functools import cache

import msgspec
from trig_sessions import PALLETISE, typed

from handeye.core.variation import WorldSpec
from handeye.ports.clock import Clock
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.trig.jobs.benches import TaughtPlan
from handeye.systems.trig.jobs.table import purbrick
from handeye.systems.trig.language.command_input import Script, hear
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.run.job import setup_of_job


class Ticking(Clock):
    """A clock that lets any time pass."""

    now = 0.0

    def advance(self, seconds: float) -> None:
        self.now += seconds


class Bench:
    """A session with the Purbrick arm."""

    def __init__(self, text: str = "") -> None:
        self.arm, self.table = purbrick()
        self.told: list[str] = []
        self.session = Session(arm=self.arm, table=self.table, desk=Script(()))
        self.halted: Callable[[], bool] = lambda: False
        self.type(text)

    def type(self, text: str) -> None:
        """Type lines."""
        script = Script(text.splitlines(), self.told.append, lambda: self.halted())
        self.session.desk = script
        while (line := script.next_line()) is not None:
            hear(self.session, line)

    @property
    def at(self) -> tuple[float, ...]:
        """Where the arm really is, mm."""
        return tuple(1000 * value for value in self.arm._axes.read().q[:3])

    @property
    def blocks(self) -> list[tuple[float, ...]]:
        """Where the blocks are, mm."""
        return [tuple(1000 * pose[:3, 3] + 6 * pose[:3, 2]) for pose in self.table.poses.values()]


def taught(text: str, table: str) -> Bench:
    """A bench with a program that was taught to an arm without physics, the table laid as before it was taught."""
    bench = Bench()
    bench.session.program = typed(text).program
    bench.type(f"* CLEAR\n{table}\nGOPOS CENTER")
    return bench


def low_palletiser(blocks: int) -> str:
    """The palletiser for few blocks, with the arm no higher and no farther out than it takes them."""
    low = PALLETISE.replace("Z 260", "Z 45").replace("Z 270 X", "Z 55 X").replace("Z 270", "Z 60")
    near = (
        low.replace("X 150", "X 60")
        .replace("Y 150 Z 200", "Y 60 Z 60")
        .replace("X -50 Y -100", "X -20 Y -40")
    )
    return near.replace("STACK 20", f"STACK {blocks}")


def low_job(blocks: int, seed: int) -> Runner:
    """The palletiser with the arm no higher than it takes few blocks, taught in the world of a seed."""
    return Runner(_low_taught(blocks, seed))


@cache
def _low_taught(blocks: int, seed: int) -> Checkpoint:
    """The state in which it has been taught: typing the script moves the arm, which takes most of the time."""
    return Runner(low_setup(blocks, seed)).checkpoint()


def low_setup(blocks: int, seed: int) -> Checkpoint:
    """A run of it that has not begun."""
    start = setup_of_job("palletise", WorldSpec(seed=seed), blocks)
    plan = TaughtPlan(job="palletise", script=low_script(blocks))
    return msgspec.structs.replace(start, setup=msgspec.structs.replace(start.setup, plan=plan))


def low_script(blocks: int) -> str:
    """What is typed for it."""
    text = low_palletiser(blocks)
    return text if blocks else text.replace("* STACK 0 X 60 Y 0", "")
