"""Renders the view of a camera of the scene for each frame of a recorded run. The view is computed from the recorded
poses.

No port of the robot gives this view, because the view shows the true places of the parts.
"""

from collections.abc import Iterator
from typing import Final

import cv2
import numpy as np

from handeye.cell.photograph import Photograph, Photographer
from handeye.cell.posed import posed
from handeye.core.pose import Array
from handeye.trace.trace import Trace

WIDTH, HEIGHT = 320, 240
_FINER: Final = 2  # drawn points per point of the view along a side


def rendered_view(trace: Trace, camera: str, times: Array) -> Iterator[Photograph]:
    """Yield the picture that a camera of the scene gives at each of `times` (s, ascending). A picture has the shape
    (240, 320, 3) and shows no shadows. For a time before the recording, the picture shows the first recorded state.
    For a time after the recording, the picture shows the last recorded state.

    A view is drawn only when a body has moved. At all other times, the previous view is repeated, so a clock on the
    wall shows the time of the last motion.

    Raises:
        InvalidInput: the scene has no such camera, or OpenGL cannot be used.
    """
    photographer = Photographer(
        trace.scene, width=_FINER * WIDTH, height=_FINER * HEIGHT, samples=0, shadows=False
    )
    drawn, view = None, np.empty(0, np.uint8)
    for time in np.clip(times, *trace.covers).tolist():
        moment = trace.at(time)
        poses = dict(moment.poses)
        if poses != drawn:
            fine = photographer.take(*posed(trace.scene, poses, moment.time), camera)
            view = np.asarray(cv2.resize(fine, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA), np.uint8)
            drawn = poses
        yield view
