"""The paper's two examples as tasks, with the checks that their referee makes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final, Literal

import numpy as np

from handeye.core.errors import Refused
from handeye.core.faults import Catalogue
from handeye.core.pose import Array
from handeye.core.units import MILLIMETRES
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Finding, Findings
from handeye.machines.purbrick import PURBRICK
from handeye.systems.trig.jobs.benches import read_taught_plan
from handeye.systems.trig.jobs.referee import judge_back, judge_dropped, judge_hand, judge_placed
from handeye.systems.trig.jobs.table import BlockTable
from handeye.systems.trig.jobs.witness import SEEN, InitialScene, ObservedScene, stands
from handeye.systems.trig.jobs.world import FAULTS, VARIATION, BlocksWorld
from handeye.systems.trig.language.command_input import stripped
from handeye.systems.trig.language.desk import MARK, arrange
from handeye.systems.trig.language.place import Place
from handeye.tasks.interface import AnyTask, Words

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.truth import Truth

ROWS: Final = 3
COLUMNS: Final = 5
BUCKET: Final = (0.140, 0.0)  # m, where the script puts it
_DROPPED: Final = 2  # blocks: the dropped one, and its replacement


class _BlocksTask(AnyTask):
    camera = "people"
    force_axes = "the hand's own axes"
    measures = MILLIMETRES

    @property
    def joint_kinds(self) -> Mapping[str, Literal["revolute", "prismatic"]]:
        return {spec.name: spec.kind for spec in PURBRICK.axes}

    def variation(self) -> Variation:
        return VARIATION

    def faults(self, world: WorldSpec) -> Catalogue:
        return FAULTS

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return BlockTable(BlocksWorld(spec)).bench.model

    def recorded_scene(self, spec: WorldSpec, plan: bytes) -> mujoco.MjModel:
        table = BlockTable(BlocksWorld(spec))
        lay(table, read_taught_plan(plan, "the plan of the run").script)
        return table.bench.model


class Pallet(_BlocksTask):
    """Move a stack into a pallet of three rows and five columns."""

    name = "palletise"
    words = Words(
        product="the pallet", done="The pallet is loaded.", apart="Every block is back in the stack."
    )

    def judge(self, truth: Truth) -> Findings:
        return self.judge_built(initial_scene(truth), stands(truth.data, initial_scene(truth).blocks))

    def judge_built(self, seen: InitialScene, stood: ObservedScene) -> Findings:
        """Return the findings on the work in the scene `stood`, which was observed at one moment."""
        placed = judge_placed(seen.poses, stood.poses, self.places(seen))
        return {**placed, "hand": _ends_at(seen, stood, "DONE")}

    def judge_apart(self, truth: Truth) -> Findings:
        seen = initial_scene(truth)
        stood = stands(truth.data, seen.blocks)
        back = judge_hand(np.array(stood.hand), np.array(seen.hand), "began")
        return {**judge_back(seen.poses, stood.poses), "hand": back}

    def places(self, seen: InitialScene) -> list[Place]:
        """Return the places at which the arm releases the blocks, one after the other. These places are computed from
        the taught positions.
        """
        above, places = seen.place("PALLET"), []
        for _ in range(COLUMNS):
            for _ in range(ROWS):
                places.append(above.moved(seen.place("PLACE")))
                above = above.moved(seen.place("NEXT-ROW"))
            above = above.moved(seen.place("NEWROW"))
        return places[: len(seen.blocks)]


class Bucket(_BlocksTask):
    """Drop a block into a bucket, and put another block where the first one was."""

    name = "bucket"
    words = Words(
        product="the bucket", done="The block is in the bucket, and another block is where the first one was."
    )

    def judge(self, truth: Truth) -> Findings:
        seen = initial_scene(truth)
        stood = stands(truth.data, seen.blocks)
        blocks = [*stood.poses.values()]
        if len(blocks) != _DROPPED:
            raise Refused(f"the referee needs {_DROPPED} blocks, but the script placed {len(blocks)}")
        place: Array = np.array(seen.place("BLOCK")[:2])
        dropped = judge_dropped(blocks[0], BUCKET, place, blocks[1])
        return {**dropped, "hand": _ends_at(seen, stood, "CENTER")}


class Arrange(_BlocksTask):
    """Place blocks as a user's script says. Only a referee that the user provides can judge the work. The task's own
    referee judges only whether the reversal has undone the work.
    """

    name = "arrange"
    words = Words(
        product="the arrangement", done="The program has ended.", apart="Every block is back in its place."
    )

    def judge(self, truth: Truth) -> Findings:
        return {}

    def judge_apart(self, truth: Truth) -> Findings:
        seen = initial_scene(truth)
        return judge_back(seen.poses, stands(truth.data, seen.blocks).poses)


def _ends_at(seen: InitialScene, stood: ObservedScene, name: str) -> Finding:
    return judge_hand(np.array(stood.hand), np.array(seen.place(name)), "ends")


def lay(table: BlockTable, script: str) -> None:
    """Prepare a table. A script describes the table in some of its lines; this function reads only these lines."""
    for line in map(stripped, script.splitlines()):
        if line.startswith(MARK):
            arrange(table, line)


def initial_scene(truth: Truth) -> InitialScene:
    seen = truth.states[SEEN]
    assert isinstance(seen, InitialScene)
    return seen


PALLET: Final = Pallet()
BUCKET_TASK: Final = Bucket()
ARRANGE: Final = Arrange()
