"""Two ways to work out how much light falls on the camera's target: OpenGL off-screen, and casting rays.

Both give the same picture up to what a vidicon cannot tell apart: diffuse surfaces without texture or gloss,
lights with shadows, an ambient level, four samples for every picture point. For one state of the scene each
gives the same values every time. Neither changes the state.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Final

import mujoco
import numpy as np

from handeye.cell.vidicon import Luminance
from handeye.core.pose import Array
from handeye.ports.camera import COLUMNS, ROWS, Renderer
from handeye.vision.camera_model import View

FINE: Final = 2
"""Samples for a picture point, along the line and across it."""
LUMA: Final = np.array([0.299, 0.587, 0.114])
"""Weights of red, green and blue in luminance, ITU-R BT.601."""
SHOWN: Final = np.array([1, 0, 1, 0, 0, 1], dtype=np.uint8)
"""Geom groups the camera sees: the ground and the parts, and 5, which people leave out; not 1, scenery for people."""


class SceneRenderer(ABC):
    """Makes luminance of a scene and a view."""

    identity: Renderer

    @abstractmethod
    def render(self, data: mujoco.MjData, view: View) -> Luminance:
        """Light on the target, shape (256, 333); `data` must be up to date on geoms and lights."""


RendererMaker = Callable[[mujoco.MjModel], SceneRenderer]
"""Makes the renderer of a scene."""


def averaged(fine: Array | Luminance) -> Luminance:
    """The mean of the samples of every point."""
    lines = fine.reshape(ROWS, FINE, COLUMNS * FINE).sum(axis=1)
    return np.asarray(lines.reshape(ROWS, COLUMNS, FINE).sum(axis=2) / FINE**2, dtype=np.float32)
