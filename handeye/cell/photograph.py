"""Colour photographs of the cell, taken with the cameras of the scene. The arm program never sees these photographs."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.film_stock import PLAIN, TONES
from handeye.cell.lighting import SHADOWED, SKY_SHADOWED, lamp_place
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
    """A close view of a place, seen from the side on which a camera of the scene stands."""

    camera: str
    place: tuple[float, float, float]  # W, m
    distance: float  # m
    turned: float = 0.0
    """Angle by which the viewpoint is turned about the place, in degrees, counter-clockwise as seen from above."""


class Photographer:
    """Takes photographs of one scene, which is loaded into OpenGL once. The bodies may be at different places from one
    photograph to the next.
    """

    def __init__(
        self, scene: mujoco.MjModel, *, width: int, height: int, shadow: int = FINE_SHADOW,
        samples: int = FINE_SAMPLES, shadows: bool = True,
    ) -> None:  # fmt: skip
        """Prepare for photographs. Raises InvalidInput if OpenGL cannot be used. If the shadow map is smaller than
        usual, a photograph takes half the time; without shadows, it takes a third of the time.
        """
        _, self._gl = context()
        self._drawing = drawing(scene, {"shadowsize": shadow, "offsamples": samples}, width, height)
        self._drawing.shadowScale, self._drawing.shadowClip = SHADOWED, SKY_SHADOWED * scene.stat.extent
        self._viewport = mujoco.MjrRect(0, 0, width, height)
        self._scene = mujoco.MjvScene(scene, maxgeom=MOST_GEOMS)
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = shadows
        self._option = mujoco.MjvOption()
        self._option.geomgroup[:] = SHOWN
        self._option.sitegroup[:] = 0

    def take(self, model: mujoco.MjModel, data: mujoco.MjData, view: str | Near) -> Photograph:
        """Take a photograph of `model`, which is the scene, or a copy of the scene in which other groups of shapes are
        visible. If the scene states the place of a lamp for photographs, that lamp lights the photograph. Raises
        InvalidInput if the scene does not have this camera.
        """
        self.aimed(model, data, view)
        if lamp_place(model) is None:
            return self.exposed()
        PLAIN.throw_once(self._scene, model)
        return np.asarray(cv2.LUT(self.exposed(), TONES), dtype=np.uint8)

    def aimed(self, model: mujoco.MjModel, data: mujoco.MjData, view: str | Near) -> mujoco.MjvScene:
        """Return the shapes, camera and lights of a view. The caller may change the shapes, camera and lights before
        the exposure. Raises InvalidInput if the scene does not have this camera.
        """
        every = int(mujoco.mjtCatBit.mjCAT_ALL)
        mujoco.mjv_updateScene(model, data, self._option, None, _eye(model, data, view), every, self._scene)
        return self._scene

    def exposed(self) -> Photograph:
        """Take the photograph of the view for which `aimed` was last called."""
        self._draw()
        rgb = np.zeros((self._viewport.height, self._viewport.width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(rgb, None, self._viewport, self._drawing)
        return rgb[::-1]

    def depth(self) -> NDArray[np.float32]:
        """Return the depth of each point, from 0 at the near clipping plane to 1 at the far one, shape (height,
        width).
        """
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
    """Take a photograph with a camera of the scene. Raises InvalidInput if the camera or OpenGL is missing."""
    _number(model, camera)
    return Photographer(model, width=width, height=height).take(model, data, camera)


def _number(model: mujoco.MjModel, camera: str) -> int:
    """Return the number of a camera of the scene. Raises InvalidInput if the scene does not have it."""
    names = [model.camera(i).name for i in range(model.ncam)]
    if camera not in names:
        there = f"the cameras are {', '.join(names)}" if names else "the scene has no cameras"
        raise NoSuchName(f"there is no camera {camera}; {there}")
    return names.index(camera)


def _eye(model: mujoco.MjModel, data: mujoco.MjData, view: str | Near) -> mujoco.MjvCamera:
    """Make the camera object of the simulator for a view."""
    eye = mujoco.MjvCamera()
    if isinstance(view, str):
        eye.type, eye.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, _number(model, view)
        return eye
    way = np.subtract(view.place, data.cam_xpos[_number(model, view.camera)])
    eye.type, eye.lookat[:], eye.distance = mujoco.mjtCamera.mjCAMERA_FREE, view.place, view.distance
    eye.azimuth = np.degrees(np.arctan2(way[1], way[0])) + view.turned
    eye.elevation = np.degrees(np.arctan2(way[2], np.hypot(way[0], way[1])))
    return eye


def smooth_photograph(
    model: mujoco.MjModel, data: mujoco.MjData, *, camera: str, width: int, height: int
) -> Photograph:
    """Take a photograph that is drawn at twice its size and averaged. Raises InvalidInput as `photograph` does, and
    also if the size is impossible.
    """
    return next(smooth_photographs(model, data, cameras=[camera], width=width, height=height))


def smooth_photographs(
    model: mujoco.MjModel, data: mujoco.MjData, *, cameras: Sequence[str], width: int, height: int
) -> Iterator[Photograph]:
    """Take a smooth photograph with each camera; the scene is loaded once. Raises InvalidInput as
    `smooth_photograph` does.

    Each point of a photograph is the mean of four rendered points. More samples for a rendered point would change the
    photograph by a tenth of a level on average, and would more than double the computing time.
    """
    check_size(width, height)
    for camera in cameras:
        _number(model, camera)
    photographer = Photographer(model, width=2 * width, height=2 * height, samples=0)
    for camera in cameras:
        fine = photographer.take(model, data, camera)
        yield np.asarray(cv2.resize(fine, (width, height), interpolation=cv2.INTER_AREA), dtype=np.uint8)


def check_size(width: int, height: int) -> None:
    """Check the size of a photograph. Raises InvalidInput if the size is impossible."""
    whole = all(isinstance(side, (int, np.integer)) for side in (width, height))
    if not (whole and SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
        raise BadArgument(
            f"a picture of {width} x {height} is not possible; each side must have {SMALLEST} to {LARGEST} pixels"
        )


def png(picture: Photograph) -> bytes:
    """Encode a picture as a PNG file."""
    done, data = cv2.imencode(".png", picture[:, :, ::-1])
    assert done
    return data.tobytes()
