"""The task of the counter machine, in which there is nothing to see or to judge."""

from collections.abc import Mapping
from typing import Final, Literal

import mujoco

from handeye.cell.truth import Truth
from handeye.core.errors import Refused
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Findings
from handeye.tasks.interface import AnyTask, Words


class Counting(AnyTask):
    """It has no arm, no scene and no referee."""

    name = "counting"
    words = Words(product="the count", done="All is counted.")
    joint_kinds: Mapping[str, Literal["revolute", "prismatic"]] = {}

    def variation(self) -> Variation:
        return Variation()

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        raise Refused("nothing can be seen of counting")

    def judge(self, truth: Truth) -> Findings:
        return {}


COUNTING: Final = Counting()
