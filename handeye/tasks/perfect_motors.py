"""Defines the task for a program that runs on perfect motors. No errors are drawn, and there is no referee."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal

from handeye.core.errors import Refused
from handeye.core.units import MILLIMETRES
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Findings
from handeye.tasks.interface import AnyTask, Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth


class PerfectMotors(AnyTask):
    """A task for perfect motors, without scene and referee."""

    words = Words(product="the program", done="The program has ended.")
    joint_kinds: Mapping[str, Literal["revolute", "prismatic"]] = {}
    measures = MILLIMETRES

    def __init__(self, name: str) -> None:
        self.name = name

    def variation(self) -> Variation:
        return Variation()

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        raise Refused("perfect motors have no scene that could be shown")

    def judge(self, truth: Truth) -> Findings:
        return {}
