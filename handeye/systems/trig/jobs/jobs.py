"""The paper's two examples as jobs. A job is taught line by line in a world, then executed and judged."""

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import Final

from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchAxes
from handeye.cell.snapshot_cell import SnapshotCell
from handeye.core.pose import Array, Pose
from handeye.core.resources import plans
from handeye.core.source import read_source
from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings
from handeye.machines.purbrick import PURBRICK
from handeye.systems.trig.jobs.benches import BlockPose, JobName, Moment, TaughtJob
from handeye.systems.trig.jobs.referee import judge_program
from handeye.systems.trig.jobs.table import BlockTable
from handeye.systems.trig.jobs.task import ARRANGE, BUCKET, BUCKET_TASK, PALLET, lay
from handeye.systems.trig.jobs.witness import ObservedScene, Witness, stands
from handeye.systems.trig.jobs.world import WEAK, BlocksWorld
from handeye.systems.trig.language.axes_arm import AxesArm
from handeye.systems.trig.language.command_input import LineRefused, Script, type_script
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.trig_arm import Halted

_LAST_STACK: Final = re.compile(r"\* STACK 20 (X \S+ Y \S+)")  # the one for a run; the first is for teaching


def script_of(name: JobName, blocks: int) -> str:
    """Return the script of a job. `blocks` is the number of blocks in the palletiser's stack."""
    text = read_source(plans() / f"{name}.trig").text
    if name != "palletise":
        return text
    return _LAST_STACK.sub(rf"* STACK {blocks} \1" if blocks else "", text)


class _Job(TaughtJob):
    axes: BenchAxes

    def __init__(self, script: str, world: BlocksWorld) -> None:
        self._script, self._world = script, world
        self._table, self._witness = BlockTable(world), Witness()
        weak = world.fault(WEAK)
        hand = PURBRICK.hand if weak is None else replace(PURBRICK.hand, force=weak)
        self.axes = replace(PURBRICK, hand=hand).on_bench(self._table.bench, world.bending)
        self.arm = AxesArm(self.axes, self._table.bench, PURBRICK.limits)
        self.session = Session(arm=self.arm, table=self._table, desk=Script(()), files=False)

    @property
    def bench(self) -> Bench:
        return self._table.bench

    @cached_property
    def cell(self) -> SnapshotCell:
        return self._table.bench.cell(self._witness)

    def teach(self, halted: Halted) -> None:
        script = Script(self._script.splitlines(), halted=halted, slip=self._world.slip)
        self.session.desk = script
        try:
            type_script(self.session, script, "the script")
        except LineRefused as refused:
            raise refused.on("the arm of this world") from None
        self._witness.look(self.bench.data, self._table.poses, self.session.program)

    def lay(self) -> None:
        lay(self._table, self._script)

    def lying(self, when: Moment) -> tuple[BlockPose, ...]:
        return tuple(
            BlockPose(
                name=name, at=_mm(X[:3, 3]), turned=round(math.degrees(math.atan2(X[1, 0], X[0, 0])), 3)
            )
            for name, X in self._taken(self._stood(when).poses)
        )

    def _stood(self, when: Moment) -> ObservedScene:
        began = self._witness.began
        if when == "taught":
            return began
        turned = began.turned if when == "turned" else None
        return turned or stands(self.bench.data, began.blocks)

    def _taken(self, poses: dict[str, Pose]) -> list[tuple[str, Pose]]:
        """Return the names and poses of the blocks, in the order in which the arm picks them up."""
        return list(poses.items())

    def turn(self) -> None:
        self._witness.turn(self.bench.data)


class PalletJob(_Job):
    """The second example: move a stack into a pallet of three rows and five columns."""

    task, undoable = PALLET, True

    def _taken(self, poses: dict[str, Pose]) -> list[tuple[str, Pose]]:
        return super()._taken(poses)[::-1]

    def built(self) -> Findings:
        return PALLET.judge_built(self._witness.began, self._stood("turned"))

    @property
    def stack(self) -> int:
        return len(self._witness.began.blocks)

    def remembered(self) -> Findings:
        program = self.session.program
        pallet = program.positions["PALLET"]
        return judge_program(
            (pallet.data, pallet.init), [node.count for node in program.graph.nodes.values()]
        )

    @property
    def goals(self) -> tuple[tuple[float, float], ...]:
        return tuple((x, y) for x, y, _ in map(_mm, PALLET.places(self._witness.began)))


class BucketJob(_Job):
    """The first example: drop a block into a bucket, and put another block where the first one was."""

    task, undoable = BUCKET_TASK, False

    @property
    def goals(self) -> tuple[tuple[float, float], ...]:
        a, b = BUCKET, self._witness.began.place("BLOCK")
        return (a[0] / MILLIMETRE, a[1] / MILLIMETRE), _mm(b)[:2]


class ArrangeJob(_Job):
    """A job of a user's own script, which places blocks anywhere."""

    task, undoable = ARRANGE, True
    goals: tuple[tuple[float, float], ...] = ()


def _mm(at: Sequence[float] | Array) -> tuple[float, float, float]:
    """Convert coordinates (m) to mm, rounded to a thousandth."""
    x, y, z = (round(float(value) / MILLIMETRE, 3) for value in at[:3])
    return x, y, z
