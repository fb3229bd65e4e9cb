"""Colour photographs of the cell, through the cameras of the scene; the arm program never sees them."""

from dataclasses import dataclass
from typing import Final

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.opengl import MOST_GEOMS, context, drawing
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.files import Kind

PNG: Final = Kind("PNG picture", rb"\x89PNG\r\n\x1a\n", ending=".png")
SMALLEST: Final = 8
LARGEST: Final = 2048  # points along a side
FINE_SHADOW: Final = 4096
FINE_SAMPLES: Final = 4
SHOWN: Final = np.array([1, 1, 1, 0, 0, 0], dtype=np.uint8)

Photograph = NDArray[np.uint8]  # red, green and blue of every point, shape (height, width, 3)


@dataclass(frozen=True, slots=True, kw_only=True)
class Near:
    """A close view of a place, from the side on which a camera of the scene stands."""

    camera: str
    place: tuple[float, float, float]  # W, m
    distance: float  # m
    turned: float = 0.0
    """Angle by which the viewpoint is turned about the place, counterclockwise seen from above, degrees."""


class Photographer:
    """Takes photographs of one scene, which is loaded into OpenGL once; bodies may be elsewhere in each photograph."""

    def __init__(
        self, scene: mujoco.MjModel, *, width: int, height: int, shadow: int = FINE_SHADOW,
        samples: int = FINE_SAMPLES,
    ) -> None:  # fmt: skip
        """Prepare for pictures; raises InvalidInput without OpenGL. A smaller shadow map halves the time per
        picture.
        """
        _, self._gl = context()
        self._drawing = drawing(scene, {"shadowsize": shadow, "offsamples": samples}, width, height)
        self._viewport = mujoco.MjrRect(0, 0, width, height)
        self._scene = mujoco.MjvScene(scene, maxgeom=MOST_GEOMS)
        self._option = mujoco.MjvOption()
        self._option.geomgroup[:] = SHOWN
        self._option.sitegroup[:] = 0

    def take(self, model: mujoco.MjModel, data: mujoco.MjData, view: str | Near) -> Photograph:
        """A photograph of the scene, or of a copy with other groups visible; raises InvalidInput if there is no
        such camera.
        """
        self.aimed(model, data, view)
        return self.exposed()

    def aimed(self, model: mujoco.MjModel, data: mujoco.MjData, view: str | Near) -> mujoco.MjvScene:
        """Shapes, camera and lights of a view, which may be changed before the exposure; raises InvalidInput if
        there is no such camera.
        """
        every = int(mujoco.mjtCatBit.mjCAT_ALL)
        mujoco.mjv_updateScene(model, data, self._option, None, _eye(model, data, view), every, self._scene)
        return self._scene

    def exposed(self) -> Photograph:
        """The picture of the view that was aimed at."""
        self._draw()
        rgb = np.zeros((self._viewport.height, self._viewport.width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(rgb, None, self._viewport, self._drawing)
        return rgb[::-1]

    def depth(self) -> NDArray[np.float32]:
        """The depth of each point, 0 at the near clipping plane and 1 at the far one, shape (height, width)."""
        self._draw()
        depth = np.zeros((self._viewport.height, self._viewport.width), dtype=np.float32)
        mujoco.mjr_readPixels(None, depth, self._viewport, self._drawing)
        return depth[::-1]

    def _draw(self) -> None:
        self._gl.make_current()
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._drawing)
        mujoco.mjr_render(self._viewport, self._scene, self._drawing)


def photograph(
    model: mujoco.MjModel, data: mujoco.MjData, *, camera: str, width: int, height: int
) -> Photograph:
    """Take a photograph with a camera of the scene; raises InvalidInput if the camera or OpenGL is missing."""
    _number(model, camera)
    return Photographer(model, width=width, height=height).take(model, data, camera)


def _number(model: mujoco.MjModel, camera: str) -> int:
    """The number of a camera of the scene; raises InvalidInput if there is no such camera."""
    names = [model.camera(i).name for i in range(model.ncam)]
    if camera not in names:
        there = f"there are {', '.join(names)}" if names else "the scene has none"
        raise NoSuchName(f"no camera {camera}; {there}")
    return names.index(camera)


def _eye(model: mujoco.MjModel, data: mujoco.MjData, view: str | Near) -> mujoco.MjvCamera:
    """The simulator's camera object for a view."""
    eye = mujoco.MjvCamera()
    if isinstance(view, str):
        eye.type, eye.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, _number(model, view)
        return eye
    way = np.subtract(view.place, data.cam_xpos[_number(model, view.camera)])
    eye.type, eye.lookat[:], eye.distance = mujoco.mjtCamera.mjCAMERA_FREE, view.place, view.distance
    eye.azimuth = np.degrees(np.arctan2(way[1], way[0])) + view.turned
    eye.elevation = np.degrees(np.arctan2(way[2], np.hypot(way[0], way[1])))
    return eye


def photograph_png(model: mujoco.MjModel, data: mujoco.MjData, camera: str, width: int, height: int) -> bytes:
    """A smooth photograph as a PNG file; raises the same errors as `smooth_photograph`."""
    return png(smooth_photograph(model, data, camera=camera, width=width, height=height))


def smooth_photograph(
    model: mujoco.MjModel, data: mujoco.MjData, *, camera: str, width: int, height: int
) -> Photograph:
    """A photograph that is drawn at twice the size and averaged; raises the same errors as `photograph`, and
    InvalidInput for an impossible size.
    """
    check_size(width, height)
    fine = photograph(model, data, camera=camera, width=2 * width, height=2 * height)
    return np.asarray(cv2.resize(fine, (width, height), interpolation=cv2.INTER_AREA), dtype=np.uint8)


def check_size(width: int, height: int) -> None:
    """Check the size of a photograph; raises InvalidInput if it is impossible."""
    whole = all(isinstance(side, (int, np.integer)) for side in (width, height))
    if not (whole and SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
        raise BadArgument(
            f"a picture of {width} x {height} is not possible; a side has {SMALLEST} to {LARGEST} pixels"
        )


def png(picture: Photograph) -> bytes:
    """A picture as a PNG file."""
    done, data = cv2.imencode(".png", picture[:, :, ::-1])
    assert done
    return data.tobytes()
