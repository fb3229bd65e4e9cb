"""Both examples of the paper as jobs: typed line by line in a drawn world, carried out, and judged."""

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np

from handeye.cell.bench import Bench
from handeye.judge.finding import Finding, Findings
from handeye.pose import Array, Pose
from handeye.resources import plans
from handeye.source import read_source
from handeye.tasks.benches import Lying, TaughtJob
from handeye.tasks.blocks.bench import purbrick
from handeye.tasks.blocks.machine import SPECS
from handeye.tasks.blocks.referee import (
    judge_back,
    judge_dropped,
    judge_hand,
    judge_placed,
    judge_program,
)
from handeye.tasks.blocks.world import BlocksWorld
from handeye.trig.place import Place
from handeye.trig.script import Script, type_script
from handeye.trig.session import Session
from handeye.trig.teachable import Halted
from handeye.units import MILLIMETRE

ROWS: Final = 3
COLUMNS: Final = 5
_LAST_STACK: Final = re.compile(r"\* STACK 20 (X \S+ Y \S+)")
"""What is laid for a run; the stack before it is for teaching."""
_BUCKET: Final = (0.140, 0.0)
"""m: where the script puts it."""


class _Job(TaughtJob):
    """A script, and the bench on which it is typed."""

    def __init__(self, world: BlocksWorld, file: Path) -> None:
        self._world, self._file = world, file
        arm, self._table = purbrick(world)
        self.session = Session(arm=arm, table=self._table, desk=Script(()))
        self._before, self._began = self._table.poses, self._hand

    @property
    def bench(self) -> Bench:
        return self._table.bench

    def teach(self, halted: Halted) -> None:
        script = Script(self._text().splitlines(), halted=halted, slip=self._world.slip)
        self.session.desk = script
        type_script(self.session, script, self._file.name)
        self._before, self._began = self._table.poses, self._hand

    def _text(self) -> str:
        return read_source(self._file).text

    @property
    def _hand(self) -> Array:
        """Where the hand truly is over the platter, shape (6,)."""
        data = self._table.bench.data
        return np.array([data.joint(spec.name).qpos[0] for spec in SPECS])

    def lying(self) -> tuple[Lying, ...]:
        return tuple(
            Lying(name=name, at=_mm(X[:3, 3]), turned=round(math.degrees(math.atan2(X[1, 0], X[0, 0])), 3))
            for name, X in self._taken()
        )

    def _taken(self) -> list[tuple[str, Pose]]:
        """Names and poses of the blocks in the order in which they are taken."""
        return list(self._table.poses.items())

    def _ends_at(self, name: str) -> Finding:
        return judge_hand(self._hand, np.array(self._taught(name)), "ends")

    def _taught(self, name: str) -> Place:
        return self.session.program.positions[name].init


class PalletJob(_Job):
    """The second example: a stack is put into a pallet of three rows and five columns."""

    def __init__(self, world: BlocksWorld, blocks: int) -> None:
        super().__init__(world, plans() / "palletise.trig")
        self._blocks = blocks

    def _text(self) -> str:
        laid = rf"* STACK {self._blocks} \1" if self._blocks else ""
        return _LAST_STACK.sub(laid, super()._text())

    def _taken(self) -> list[tuple[str, Pose]]:
        return super()._taken()[::-1]

    def findings(self) -> Findings:
        placed = judge_placed(self._before, self._table.poses, self._places)
        return {**placed, "hand": self._ends_at("DONE")}

    def findings_back(self) -> Findings:
        program = self.session.program
        pallet = program.positions["PALLET"]
        return {
            **judge_back(self._before, self._table.poses),
            "hand": judge_hand(self._hand, self._began, "began"),
            **judge_program(
                (pallet.data, pallet.init), [node.count for node in program.graph.nodes.values()]
            ),
        }

    @property
    def goals(self) -> tuple[tuple[float, float], ...]:
        return tuple((x, y) for x, y, _ in map(_mm, self._places))

    @property
    def _places(self) -> list[Place]:
        return self._grid[: self._blocks]

    @property
    def _grid(self) -> list[Place]:
        """Where the hand lets go one block after another, as it was taught."""
        above, places = self._taught("PALLET"), []
        for _ in range(COLUMNS):
            for _ in range(ROWS):
                places.append(above.moved(self._taught("PLACE")))
                above = above.moved(self._taught("NEXT-ROW"))
            above = above.moved(self._taught("NEWROW"))
        return places


class BucketJob(_Job):
    """The first example: a block is dropped into a bucket, and another one is put in its place."""

    def __init__(self, world: BlocksWorld) -> None:
        super().__init__(world, plans() / "bucket.trig")

    def findings(self) -> Findings:
        a, b = self._table.poses.values()
        place = np.array(self._taught("BLOCK")[:2])
        found = judge_dropped(a, _BUCKET, place, b)
        return {**found, "hand": self._ends_at("CENTER")}

    def findings_back(self) -> None:
        return None

    @property
    def goals(self) -> tuple[tuple[float, float], ...]:
        a, b = _BUCKET, self._taught("BLOCK")
        return (a[0] / MILLIMETRE, a[1] / MILLIMETRE), _mm(b)[:2]


def _mm(at: Sequence[float] | Array) -> tuple[float, float, float]:
    """The first three of a place's coordinates (m), in mm to a thousandth."""
    x, y, z = (round(float(value) / MILLIMETRE, 3) for value in at[:3])
    return x, y, z
