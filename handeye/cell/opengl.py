"""Off-screen pictures by OpenGL, on a computer without a display.

This module tests the OpenGL libraries, and then makes the OpenGL context itself. When MuJoCo is first imported, it
chooses a library by an environment variable. This module does not use that choice, so the result does not depend on
the order of imports.
"""

import contextlib
import ctypes
import importlib
import os
from collections.abc import Iterator, Mapping
from functools import cache, cached_property
from typing import Any, Final

import mujoco
import numpy as np

from handeye.cell.rendering import FINE, LUMA, SHOWN, SceneRenderer, averaged
from handeye.cell.vidicon import Luminance
from handeye.core.errors import Refused
from handeye.ports.camera import COLUMNS, ROWS, Renderer
from handeye.vision.camera_model import View

PLATFORMS: Final = (
    ("EGL", "mujoco.egl", ("libEGL.so.1",), ("libOpenGL.so.0", "libGL.so.1")),
    ("OSMesa", "mujoco.osmesa", ("libOSMesa.so.8", "libOSMesa.so"), ()),
)
"""For each platform: its name, its module, and the libraries that it needs. For each library, the alternatives are
listed; the platform needs only one of these alternatives.
"""
SETTINGS: Final = ("EGL_", "GALLIUM_", "LIBGL_", "MESA_", "MUJOCO_EGL_", "PYOPENGL_", "__EGL_", "__GLX_")
"""Prefixes of the environment variables by which a user selects a device or a driver."""
NEAR, FAR = 0.3, 10.0  # clipping planes, in m
MOST_GEOMS: Final = 10000

_WIDTH, _HEIGHT = COLUMNS * FINE, ROWS * FINE

_QUALITY: Final = {"shadowsize": 4096, "offsamples": 0, "numstacks": 2}
"""Quality of pictures: points of the shadow map, samples per fine point, and rings along a cylinder.

More samples and rings would have no effect, because four fine points are averaged and the vidicon blurs the picture.
On the table, a point of the shadow map is .7 mm wide, half as wide as a point of a picture. With a coarse map of 1024
points, a point would be 2.8 mm wide, and pictures of a pump pushed by .1 mm would differ more at the edges of its
shadows. `vision/alignment.py` compares the same square of points in two pictures. In pictures of a pushed pump, such a
square differed by up to 2.6 levels with the coarse map. With the map of 4096 points, or with ray casting, the square
differed by up to 1.0 level (seed 15, 30 pictures each). With the finer map, a picture takes .05 s longer.
"""


class OpenGlRenderer(SceneRenderer):
    """Renders pictures with shadows by OpenGL, at twice the resolution of the pictures."""

    def __init__(self, model: mujoco.MjModel) -> None:
        """Raise InvalidInput if OpenGL cannot be used."""
        self._model = model
        platform, self._gl = context()
        self.identity = Renderer(method="opengl", platform=platform)
        self._scene = mujoco.MjvScene(model, maxgeom=MOST_GEOMS)
        self._camera = mujoco.MjvCamera()
        self._option = mujoco.MjvOption()
        self._option.geomgroup[:] = SHOWN
        self._option.sitegroup[:] = 0
        self._option.flags[mujoco.mjtVisFlag.mjVIS_TEXTURE] = 0
        for flag in ("REFLECTION", "SKYBOX", "FOG", "HAZE"):
            self._scene.flags[getattr(mujoco.mjtRndFlag, f"mjRND_{flag}")] = 0

    def __del__(self) -> None:
        # The objects to free belong to this context, and another renderer may have made its own context current.
        with contextlib.suppress(Exception):  # at exit the display may be gone before us
            if "_context" in self.__dict__:
                self._gl.make_current()
                self._context.free()

    @cached_property
    def _context(self) -> mujoco.MjrContext:
        """The OpenGL context with the scene. The context is made only when the first picture is taken, because making
        it takes longer than building the cell.
        """
        return drawing(self._model, _QUALITY, _WIDTH, _HEIGHT)

    def render(self, data: mujoco.MjData, view: View) -> Luminance:
        every = int(mujoco.mjtCatBit.mjCAT_ALL)
        mujoco.mjv_updateScene(self._model, data, self._option, None, self._camera, every, self._scene)
        self._aim(view)
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = self.shadows
        for light in self._scene.lights[
            : self._scene.nlight
        ]:  # no gloss, and no light meant for interactive viewers
            light.specular[:] = 0
            if light.headlight:
                light.diffuse[:] = 0
        context = self._context
        self._gl.make_current()
        # Each time: if another renderer has drawn in between, OpenGL still draws into that renderer's picture.
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, context)
        viewport = mujoco.MjrRect(0, 0, _WIDTH, _HEIGHT)
        mujoco.mjr_render(viewport, self._scene, context)
        rgb = np.empty((_HEIGHT, _WIDTH, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(rgb, None, viewport, context)
        return averaged(rgb[::-1].astype(np.float32) @ (LUMA / 255).astype(np.float32))

    def _aim(self, view: View) -> None:
        """Place the OpenGL camera where the television camera is, and give it that camera's raster of non-square
        points.
        """
        X_WC, (fx, fy) = view.X_WC, view.focal
        for eye in self._scene.camera:
            eye.pos[:] = X_WC[:3, 3]
            eye.forward[:] = X_WC[:3, 2]
            eye.up[:] = -X_WC[:3, 1]
            eye.frustum_near, eye.frustum_far = NEAR, FAR
            eye.frustum_center = 0.0
            eye.frustum_width = NEAR * COLUMNS / 2 / fx
            eye.frustum_top = NEAR * ROWS / 2 / fy
            eye.frustum_bottom = -eye.frustum_top


@contextlib.contextmanager
def replaced(record: Any, values: Mapping[str, int]) -> Iterator[None]:
    """Change values of a record of the simulator while the context is open."""
    before = {name: getattr(record, name) for name in values}
    for name, value in values.items():
        setattr(record, name, value)
    try:
        yield
    finally:
        for name, value in before.items():
            setattr(record, name, value)


def drawing(model: mujoco.MjModel, quality: Mapping[str, int], width: int, height: int) -> mujoco.MjrContext:
    """Make an OpenGL context with a scene, for pictures of a given size in points. Raises Refused if the driver
    cannot hold the scene.
    """
    context()[1].make_current()
    try:
        with replaced(model.vis.quality, quality):
            made = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_resizeOffscreen(width, height, made)
    except mujoco.FatalError as error:
        raise Refused(f"OpenGL on this machine cannot draw {width} x {height} pixels: {error}") from None
    return made


@cache
def driver() -> str:
    """Return the renderer and the version that the OpenGL library reports. Raises InvalidInput as `context` does."""
    context()[1].make_current()
    gl = importlib.import_module("OpenGL.GL")  # which MuJoCo needs, too
    return ", ".join(gl.glGetString(name).decode() for name in (gl.GL_RENDERER, gl.GL_VERSION))


@cache
def context() -> tuple[str, Any]:
    """Return two values: the name of the platform, and the only OpenGL context of this process.

    All renderers share the context, so that the objects of one renderer are never freed in the context of another.
    Raises InvalidInput if OpenGL does not work on this computer. OpenGL is tested with an empty scene, because an
    OpenGL version that is too old fails only when it is given a scene.
    """
    set_here = sorted(
        name for name, value in os.environ.items() if name.startswith(SETTINGS) and value != "egl"
    )
    reasons, present = [], False
    for name, module, *libraries in PLATFORMS:
        if not all(_loads(alternatives) for alternatives in libraries if alternatives):
            continue
        present = True
        # What a broken driver raises is not documented: ImportError, AttributeError, errors of PyOpenGL.
        with contextlib.suppress(Exception):
            gl = importlib.import_module(module).GLContext(_WIDTH, _HEIGHT)
            gl.make_current()
            try:
                mujoco.MjrContext(
                    mujoco.MjModel.from_xml_string("<mujoco/>"), mujoco.mjtFontScale.mjFONTSCALE_100
                )
            except mujoco.FatalError as error:
                reasons.append(str(error))
                continue
            return name, gl
    if present and set_here:
        reasons.append(f"unset {' and '.join(set_here)}, and run handeye again")
    if not reasons:
        reasons.append("on Debian, install libegl1, libgl1-mesa-dri and libopengl0")
    raise Refused(
        f"OpenGL does not work on this machine ({'; '.join(reasons)}); photographs need OpenGL, and so does the "
        "camera unless `--camera ray` is given"
    )


def _loads(alternatives: tuple[str, ...]) -> bool:
    for library in alternatives:
        with contextlib.suppress(OSError):
            ctypes.CDLL(library)
            return True
    return False
