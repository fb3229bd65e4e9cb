"""A still scene with parts put where one wants them, and the camera: for pictures without a run."""

import mujoco
import numpy as np

from handeye.cell.camera import SimulatedCamera, true_camera
from handeye.cell.renderers import make_renderer
from handeye.pose import Pose, pose
from handeye.tasks.water_pump.cell import PARK
from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.tasks.water_pump.scene import ARM, build


class Stage:
    """The cell of a world before it has moved, its arm parked."""

    def __init__(self, world: PumpWorld, *, renderer: str = "auto", posture: np.ndarray = PARK) -> None:
        """Raises InvalidInput if there is no such renderer, or it does not work here."""
        self.world = world
        self._model = build(world)
        self._data = mujoco.MjData(self._model)
        self.posture(posture)
        self.camera = SimulatedCamera(
            self._data, world.camera, world.generator("camera"), make_renderer(renderer, self._model)
        )
        self.true_camera = true_camera(world.camera)

    def posture(self, q: np.ndarray) -> None:
        """Stand the arm at joint positions `q`, shape (6,)."""
        for number in range(6):
            self._data.joint(f"{ARM}j{number + 1}").qpos = q[number]
        mujoco.mj_forward(self._model, self._data)

    def put(self, part: str, X_WP: Pose) -> None:
        """Put a free body at a pose, whatever is there."""
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, X_WP[:3, :3].ravel())
        self._data.joint(part).qpos = [*X_WP[:3, 3], *quat]
        mujoco.mj_forward(self._model, self._data)

    def pose(self, part: str) -> Pose:
        """`X_WP` of a body."""
        body = self._data.body(part)
        return pose(body.xmat.reshape(3, 3).copy(), body.xpos.copy())
