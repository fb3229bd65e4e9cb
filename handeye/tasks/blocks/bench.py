"""The Purbrick arm for TRIG."""

from handeye.tasks.blocks.machine import machine
from handeye.tasks.blocks.table import BlockTable
from handeye.tasks.blocks.world import BlocksWorld
from handeye.trig.axes_arm import AxesArm

NOMINAL = BlocksWorld()


def purbrick(world: BlocksWorld = NOMINAL) -> tuple[AxesArm, BlockTable]:
    """An arm that is switched on, with its hand open above the middle of an empty platter."""
    table = BlockTable(world)
    return AxesArm(machine(table.bench, world.bending), table.bench), table
