"""A still scene with parts put where one wants them, and the camera: for pictures without a run."""

import mujoco
import numpy as np

from handeye.cell.camera import SimulatedCamera, make_renderer, true_camera
from handeye.cell.device_errors import CameraErrors
from handeye.cell.keyframe import body_pose
from handeye.core.pose import Array, Pose
from handeye.vision.camera_model import CameraModel


class StillCell:
    """A scene before it has moved."""

    def __init__(
        self,
        model: mujoco.MjModel,
        *,
        posture: dict[str, float],
        drawing: CameraModel,
        errors: CameraErrors,
        noise: np.random.Generator,
        renderer: str = "auto",
    ) -> None:
        """Take a scene with joints (rad, m, by name) at a posture, and a camera that is off its drawing by `errors`."""
        self._data = mujoco.MjData(model)
        for joint, q in posture.items():
            self._data.joint(joint).qpos = q
        mujoco.mj_forward(model, self._data)
        self._model = model
        self.camera = SimulatedCamera(self._data, errors, noise, make_renderer(renderer, model), drawing)
        self.true_camera = true_camera(errors, drawing)

    def put(self, part: str, X_WP: Pose) -> None:
        """Put a free body at a pose, whatever is there."""
        quat: Array = np.zeros(4)
        mujoco.mju_mat2Quat(quat, X_WP[:3, :3].ravel())
        self._data.joint(part).qpos = [*X_WP[:3, 3], *quat]
        mujoco.mj_forward(self._model, self._data)

    def pose(self, part: str) -> Pose:
        """`X_WP` of a body."""
        return body_pose(self._data, part)
