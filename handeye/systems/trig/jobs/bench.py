"""The Purbrick arm for TRIG."""

from handeye.machines.purbrick import PURBRICK
from handeye.systems.trig.jobs.table import BlockTable
from handeye.systems.trig.jobs.world import BlocksWorld
from handeye.systems.trig.language.axes_arm import AxesArm

NOMINAL = BlocksWorld()


def purbrick(world: BlocksWorld = NOMINAL) -> tuple[AxesArm, BlockTable]:
    """A switched-on arm with an open hand above the middle of an empty platter."""
    table = BlockTable(world)
    return AxesArm(PURBRICK.on_bench(table.bench, world.bending), table.bench, PURBRICK.limits), table
