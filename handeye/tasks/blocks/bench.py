"""The Purbrick arm for TRIG."""

from handeye.tasks.blocks.machine import machine
from handeye.tasks.blocks.table import BlockTable
from handeye.trig.axes_arm import AxesArm


def purbrick() -> tuple[AxesArm, BlockTable]:
    """An arm that is switched on, with its hand open above the middle of an empty platter."""
    table = BlockTable()
    return AxesArm(machine(table.bench), table.bench), table
