"""The grasp line in a picture: from finger to finger of a hand above a part."""

import numpy as np

from handeye.core.pose import Pose
from handeye.ports.camera import COLUMNS, ROWS
from handeye.vision.camera_model import View

GraspLine = tuple[tuple[float, float], tuple[float, float]]  # two ends (u, v)


def grasp_line(view: View, X_WT: Pose, gap: float, z: float) -> GraspLine | None:
    """Where fingers `gap` (m) apart cross height `z` (m) straight below a hand; None unless all in view."""
    ends = X_WT[:3, 3] + np.array([[-0.5], [0.5]]) * gap * X_WT[:3, 1]
    ends[:, 2] = z
    (u, v), (across, down) = view.project(ends).tolist()
    if not (0 <= min(u, across) <= max(u, across) < COLUMNS and 0 <= min(v, down) <= max(v, down) < ROWS):
        return None
    return (u, v), (across, down)
