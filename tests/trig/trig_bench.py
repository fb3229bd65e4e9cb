"""TRIG sessions for tests with physics: the Purbrick arm, and a desk at which a text sits."""

from collections.abc import Callable

from trig_sessions import PALLETISE, typed

from handeye.ports.clock import Clock
from handeye.tasks.blocks.bench import purbrick
from handeye.tasks.blocks.jobs import PalletJob
from handeye.tasks.blocks.world import BlocksWorld
from handeye.trig.hearing import hear
from handeye.trig.script import Script
from handeye.trig.session import Session


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
    """The palletiser for few blocks, with the arm no higher than it takes them."""
    low = PALLETISE.replace("Z 260", "Z 45").replace("Z 270 X", "Z 55 X").replace("Z 270", "Z 60")
    return low.replace("STACK 20", f"STACK {blocks}")


class LowPalletJob(PalletJob):
    """The job of the palletiser for few blocks, with the arm no higher than it takes them."""

    def _text(self) -> str:
        text = low_palletiser(self._blocks)
        return text if self._blocks else text.replace("* STACK 0 X 150 Y 0", "")


def low_job(blocks: int, seed: int) -> LowPalletJob:
    """That job, taught in the world of a seed."""
    job = LowPalletJob(BlocksWorld(seed), blocks)
    job.teach(lambda: False)
    return job
