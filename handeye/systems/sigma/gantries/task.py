"""Defines the task of a program that moves the two gantries over an empty board. It has no referee."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final, Literal

from handeye.core.faults import Catalogue
from handeye.core.units import MILLIMETRES
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Findings
from handeye.systems.sigma.gantries.machine import CAMERA, scene
from handeye.systems.sigma.gantries.world import VARIATION, GantryWorld
from handeye.systems.sigma.protocol import AXES
from handeye.tasks.interface import AnyTask, Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth


class GantryTask(AnyTask):
    """Two gantries, and the objects on their board."""

    name = "gantries"
    words = Words(product="the program", done="The program has ended.")
    camera = CAMERA
    force_axes = "the axes of the arms"
    measures = MILLIMETRES
    joint_kinds: Mapping[str, Literal["revolute", "prismatic"]] = dict.fromkeys(AXES, "prismatic")

    def variation(self) -> Variation:
        return VARIATION

    def faults(self, world: WorldSpec) -> Catalogue:
        from handeye.systems.sigma.gantries.faults import catalogue

        return catalogue()

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return scene(GantryWorld(spec)).compile()

    def judge(self, truth: Truth) -> Findings:
        return {}


GANTRIES: Final = GantryTask()
