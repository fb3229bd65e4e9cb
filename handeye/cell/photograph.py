"""Photographs of the cell for people, in colour, through the cameras of the scene. The program never sees them."""

from typing import Final

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.opengl import MOST_GEOMS, context
from handeye.errors import InvalidInput
from handeye.files import Kind

PNG: Final = Kind("PNG picture", rb"\x89PNG\r\n\x1a\n", ending=".png")
SMALLEST: Final = 8
LARGEST: Final = 2048
"""Points along a side."""
FINE_SHADOW: Final = 4096
FINE_SAMPLES: Final = 4
SHOWN: Final = np.array([1, 1, 1, 0, 0, 0], dtype=np.uint8)

Photograph = NDArray[np.uint8]
"""Red, green and blue of every point, shape (height, width, 3)."""


def photograph(
    model: mujoco.MjModel, data: mujoco.MjData, *, camera: str, width: int, height: int
) -> Photograph:
    """Photograph by a camera of the scene.

    Raises:
        InvalidInput: no such camera, or no OpenGL on this machine.
    """
    names = [model.camera(i).name for i in range(model.ncam)]
    if camera not in names:
        raise InvalidInput(f"no camera {camera}; there are {', '.join(names)}")
    _, gl = context()
    gl.make_current()
    drawing = _drawing(model)
    mujoco.mjr_resizeOffscreen(width, height, drawing)
    mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, drawing)
    scene = mujoco.MjvScene(model, maxgeom=MOST_GEOMS)
    option = mujoco.MjvOption()
    option.geomgroup[:] = SHOWN
    option.sitegroup[:] = 0
    eye = mujoco.MjvCamera()
    eye.type, eye.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, names.index(camera)
    mujoco.mjv_updateScene(model, data, option, None, eye, int(mujoco.mjtCatBit.mjCAT_ALL), scene)
    viewport = mujoco.MjrRect(0, 0, width, height)
    mujoco.mjr_render(viewport, scene, drawing)
    rgb = np.zeros((height, width, 3), dtype=np.uint8)
    mujoco.mjr_readPixels(rgb, None, viewport, drawing)
    return rgb[::-1]


def photograph_png(model: mujoco.MjModel, data: mujoco.MjData, camera: str, width: int, height: int) -> bytes:
    """A smooth photograph as a PNG file.

    Raises:
        InvalidInput: as `smooth_photograph`.
    """
    return png(smooth_photograph(model, data, camera=camera, width=width, height=height))


def smooth_photograph(
    model: mujoco.MjModel, data: mujoco.MjData, *, camera: str, width: int, height: int
) -> Photograph:
    """A photograph that is drawn at twice the size and averaged.

    Raises:
        InvalidInput: as `photograph`, or the size cannot be.
    """
    whole = all(isinstance(side, (int, np.integer)) for side in (width, height))
    if not (whole and SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
        raise InvalidInput(
            f"a picture of {width} x {height} cannot be made; a side has {SMALLEST} to {LARGEST} points"
        )
    fine = photograph(model, data, camera=camera, width=2 * width, height=2 * height)
    return np.asarray(cv2.resize(fine, (width, height), interpolation=cv2.INTER_AREA), dtype=np.uint8)


def png(picture: Photograph) -> bytes:
    """A picture as a PNG file."""
    done, data = cv2.imencode(".png", picture[:, :, ::-1])
    assert done
    return data.tobytes()


def _drawing(model: mujoco.MjModel) -> mujoco.MjrContext:
    """A drawing context with finer shadows than the television camera needs; it keeps its own settings."""
    quality = model.vis.quality
    before = quality.shadowsize, quality.offsamples
    quality.shadowsize, quality.offsamples = FINE_SHADOW, FINE_SAMPLES
    try:
        return mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
    finally:
        quality.shadowsize, quality.offsamples = before
