"""A scene with its arm parked and held, in which parts can be put where a test wants them."""

import mujoco
import numpy as np

from handeye.core.pose import Pose, planar
from handeye.core.units import DEGREE, INCH
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, screw_holes, standard
from handeye.tasks.water_pump.scene import build
from handeye.tasks.water_pump.world.pump_world import PumpWorld

PARKED = np.array([-19.7, 104.0, 17.5, 0.0, 76.0, 70.3]) * [1, 1, INCH / DEGREE, 1, 1, 1] * DEGREE
FREE = ("base", "gasket", "top", "pin0", "pin1", "driver", *(f"screw{k}" for k in range(6)))


class Bench:
    """The physics alone, without the cell and its devices."""

    def __init__(self, world: PumpWorld | None = None) -> None:
        self.model = build(world or PumpWorld.nominal())
        for k in range(6):  # as the cell does: no thread has a screw in it
            for geom in (self.model.geom(f"head{k}"), self.model.geom(f"shank{k}")):
                geom.contype, geom.conaffinity = 0, 0
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:6] = PARKED
        mujoco.mj_forward(self.model, self.data)

    def run(self, seconds: float) -> None:
        """Let time pass; the drives carry the arm's weight."""
        for _ in range(round(seconds / self.model.opt.timestep)):
            self.data.ctrl[:6] = self.data.qfrc_bias[:6]
            mujoco.mj_step(self.model, self.data)

    def put(self, part: str, X: Pose) -> None:
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, X[:3, :3].ravel())
        self.data.joint(part).qpos = [*X[:3, 3], *quat]
        self.data.joint(part).qvel = 0
        mujoco.mj_forward(self.model, self.data)

    def pose(self, part: str) -> Pose:
        body, X = self.data.body(part), np.eye(4)
        X[:3, :3], X[:3, 3] = body.xmat.reshape(3, 3), body.xpos
        return X

    def warnings(self) -> int:
        return sum(int(warning.number) for warning in self.data.warning)


def shift(X: Pose, Y: Pose) -> tuple[float, float]:
    """How far apart two poses are: m, and degrees."""
    cosine = (np.trace(X[:3, :3].T @ Y[:3, :3]) - 1) / 2
    return float(np.linalg.norm(X[:3, 3] - Y[:3, 3])), float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def standard_base(world: PumpWorld | None = None) -> Bench:
    """A bench with the base in its standard position."""
    bench = Bench(world)
    x, y = dimensions().all("standard.place")
    bench.put("base", planar(x, y, 0.0, dimensions()("standard.yaw")))
    return bench


def pinned_base() -> Bench:
    """The same bench, with both pins dropped into their holes from a millimetre beside them."""
    bench = standard_base()
    for pin, hole in enumerate(int(k) for k in dimensions().all("base.screw_holes.pinned")):
        X = standard() @ planar(*screw_holes()[hole], 0.0, 0.0)
        X[:3, 3] += [0.001, 0.0, base_top() + 0.019]
        bench.put(f"pin{pin}", X)
    bench.run(0.4)
    return bench
