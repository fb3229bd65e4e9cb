"""Two methods to compute the light on the camera's target (the light-sensitive plate of its tube): OpenGL
off-screen, and ray casting.

Within the resolution of a vidicon, the two methods give the same picture. Both draw diffuse surfaces without texture
or gloss, lights with shadows, and an ambient level. Both take four samples for each picture point on the edge of a
solid or a shadow. For one state of the scene, each method always gives the same values. Neither changes the state.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from copy import copy
from typing import Final, Protocol

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from handeye.cell.vidicon import Luminance
from handeye.core.errors import BadArgument, InvalidInput
from handeye.core.pose import Array
from handeye.ports.camera import COLUMNS, ROWS, Renderer
from handeye.vision.camera_model import View

FINE: Final = 2  # samples for a picture point, along the line and across it
LUMA: Final = np.array([0.299, 0.587, 0.114])  # weights of red, green and blue in luminance, ITU-R BT.601
SHOWN: Final = np.array([1, 0, 1, 0, 0, 1], dtype=np.uint8)
"""Geom groups that the television camera sees: 0 (the ground), 2 (the parts) and 5 (plain shapes, which photographs
replace by finer ones). The camera does not see group 1, the decorative scenery.
"""


class SceneRenderer(ABC):
    """Computes the luminance of a scene in a view."""

    identity: Renderer
    shadows: bool = True
    """True if lights cast shadows. Without shadows an OpenGL picture takes a quarter of the time."""

    @abstractmethod
    def render(self, data: mujoco.MjData, view: View) -> Luminance:
        """Compute the light on the target, shape (256, 333). The geoms and lights in `data` must be up to date."""


RendererMaker = Callable[[mujoco.MjModel], SceneRenderer]  # makes the renderer of a scene


def averaged(fine: Array | Luminance) -> Luminance:
    """Return the mean of the samples of every point."""
    lines = fine.reshape(ROWS, FINE, COLUMNS * FINE).sum(axis=1)
    return np.asarray(lines.reshape(ROWS, COLUMNS, FINE).sum(axis=2) / FINE**2, dtype=np.float32)


_SHOWN: Final = 60  # characters shown of a value that is not a picture


class PictureMaker(Protocol):
    """Computes the light on the target of the television camera. A caller may supply a picture maker."""

    def render(self, data: mujoco.MjData, view: View, /) -> ArrayLike:
        """Compute the light on each point of the target, shape (256, 333). A white surface in full light has the value
        1. `data` is a copy of the state of the scene.
        """


CameraMaker = Callable[[mujoco.MjModel], PictureMaker]
"""Function that makes a `PictureMaker` for a scene. A class can serve as this function."""


class ReplacedCamera(SceneRenderer):
    """A picture maker supplied by the user. The picture maker gets copies of the state, so it cannot change the run."""

    def __init__(self, name: str, camera: CameraMaker, model: mujoco.MjModel) -> None:
        """Make the user's own renderer for a scene. `name` is the name of the user's code. Raises InvalidInput
        if the object that `camera` returns has no method `render`.
        """
        self.identity = Renderer(method="replaced", platform=name)
        self._scene = copy(model)
        self._maker = camera(self._scene)
        if not callable(getattr(self._maker, "render", None)):
            raise BadArgument(
                f"the camera `{self.identity.platform}` must return an object with a method `render`, not "
                f"{self._maker!r}"
            )
        self._model, self._data = model, mujoco.MjData(self._scene)

    def render(self, data: mujoco.MjData, view: View) -> Luminance:
        mujoco.mj_copyData(self._data, self._model, data)
        given = self._maker.render(self._data, view)
        try:
            light = np.asarray(given, dtype=np.float32)
        except (TypeError, ValueError):
            raise self._no_picture(repr(given)) from None
        if light.shape != (ROWS, COLUMNS):
            raise self._no_picture(f"of shape {light.shape}")
        if not np.isfinite(light).all():
            raise self._no_picture("with some values that are not finite")
        return light

    def _no_picture(self, what: str) -> InvalidInput:
        name = self.identity.platform
        return BadArgument(
            f"the camera `{name}` must give a picture of {ROWS} by {COLUMNS} finite numbers, not {what[:_SHOWN]}"
        )
