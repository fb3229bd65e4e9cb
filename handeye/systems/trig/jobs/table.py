"""The Purbrick arm for TRIG, with blocks and a bucket on its platter. Between two commands, the user can place blocks
and the bucket on the platter.
"""

import math
from typing import Final

import mujoco

from handeye.cell.bench import Bench
from handeye.cell.photograph import Photograph, photograph
from handeye.core.errors import Refused
from handeye.core.pose import Pose
from handeye.machines.purbrick import PURBRICK
from handeye.systems.trig.jobs.benches import SeenTable
from handeye.systems.trig.jobs.witness import block_poses
from handeye.systems.trig.jobs.world import ALIGNED, HEAVY, STACKED, TURNED, BlocksWorld
from handeye.systems.trig.language.axes_arm import AxesArm

HEIGHT: Final = 0.012  # m, of a block; 30 mm along and across, of aluminium: 29 g
VIEW: Final = "people"  # camera of the scene for photographs
_GAP: Final = 2e-5  # m between stacked blocks
_COLOURS: Final = ((0.72, 0.73, 0.75, 1.0), (0.50, 0.56, 0.62, 1.0))  # alternating colours
_WALL: Final = 0.003
_DEEP: Final = 0.060
_WIDE: Final = 0.035  # m, half the bucket's inside width


class BlockTable(SeenTable):
    """A bench and the objects on its platter."""

    def __init__(self, world: BlocksWorld) -> None:
        self._world, self._stacks = world, 0
        self._spec = PURBRICK.scene()
        for geom in (self._spec.geom("platter"), self._spec.find_default("block").geom):
            geom.friction[0] = world.friction
        self._spec.find_default("block").geom.density *= world.fault(HEAVY) or 1.0
        self.bench = Bench(self._spec.compile())
        key = self.bench.model.joint("z").qposadr[0]
        self.bench.data.qpos[key] = 0.3
        mujoco.mj_forward(self.bench.model, self.bench.data)
        self._names: list[str] = []

    @property
    def count(self) -> int:
        return len(self._names)

    def stack(self, count: int, x: float, y: float) -> None:
        names = [f"block_{len(self._names) + number}" for number in range(1, count + 1)]
        px, py, pz = self.bench.data.body("platter").xpos
        self._stacks += 1
        draw, here = self._world.normal, f"stack_{self._stacks}"
        x += draw(f"{here}.x", STACKED)
        y += draw(f"{here}.y", STACKED)
        for level, name in enumerate(names):
            at = [x + draw(f"{here}.{level}.x", ALIGNED), y + draw(f"{here}.{level}.y", ALIGNED)]
            half = draw(f"{here}.{level}.turn", TURNED) / 2
            z = HEIGHT / 2 + level * (HEIGHT + _GAP) + _GAP
            turned = [math.cos(half), 0, 0, math.sin(half)]
            body = self._spec.worldbody.add_body(name=name, pos=[px + at[0], py + at[1], pz + z], quat=turned)
            body.add_freejoint(name=name)
            body.add_geom(self._spec.find_default("block"), name=name, rgba=_COLOURS[level % len(_COLOURS)])
        self._names += names
        self.bench.replace(self._spec)

    def bucket(self, x: float, y: float) -> None:
        platter = self._spec.body("platter")
        if self._spec.geom("bucket_1") is not None:
            raise Refused("there is already a bucket; `* CLEAR` removes it")
        for number, (dx, dy) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1)), 1):
            size = [_WALL if dx else _WIDE + 2 * _WALL, _WALL if dy else _WIDE, _DEEP / 2]
            at = [x + dx * (_WIDE + _WALL), y + dy * (_WIDE + _WALL), _DEEP / 2]
            style = self._spec.find_default("bucket")
            platter.add_geom(style, name=f"bucket_{number}", pos=at, size=size, mass=0.05)
        self.bench.replace(self._spec)

    def clear(self) -> None:
        for name in self._names:
            self._spec.delete(self._spec.body(name))
        for number in range(1, 5):
            if (wall := self._spec.geom(f"bucket_{number}")) is not None:
                self._spec.delete(wall)
        self._names = []
        self.bench.replace(self._spec)

    def photograph(self, width: int, height: int) -> Photograph:
        return photograph(self.bench.model, self.bench.data, camera=VIEW, width=width, height=height)

    @property
    def poses(self) -> dict[str, Pose]:
        """True poses of the blocks' centres relative to the platter, for the referee. Lower blocks come first."""
        return block_poses(self.bench.data, self._names)


NOMINAL = BlocksWorld()


def purbrick(world: BlocksWorld = NOMINAL) -> tuple[AxesArm, BlockTable]:
    """Return an arm that is switched on, with an open hand above the centre of an empty platter."""
    table = BlockTable(world)
    return AxesArm(PURBRICK.on_bench(table.bench, world.bending), table.bench, PURBRICK.limits), table
