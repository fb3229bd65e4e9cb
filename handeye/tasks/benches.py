"""Benches by name: machines that no task's program drives, opened where somebody asks for one."""

from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from handeye.trig.tabletop import Tabletop
    from handeye.trig.teachable import Teachable


def open_bench(name: Literal["purbrick"]) -> "tuple[Teachable, Tabletop]":
    """An arm for TRIG that is switched on, and what lies before it."""
    from handeye.tasks.blocks.bench import purbrick  # with its physics: only where it is asked for

    return {"purbrick": purbrick}[name]()
