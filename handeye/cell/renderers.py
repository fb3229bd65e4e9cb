"""The choice of a renderer."""

import mujoco

from handeye.cell.opengl import OpenGlRenderer
from handeye.cell.raycasting import RayRenderer
from handeye.cell.rendering import RendererMaker, SceneRenderer
from handeye.core.errors import InvalidInput, NoSuchName


def make_renderer(kind: str | RendererMaker, model: mujoco.MjModel) -> SceneRenderer:
    """A renderer: `gl`, `ray`, or `auto`: OpenGL where it works, rays elsewhere; or one made by the given function.

    Raises InvalidInput if there is no such `kind`, or OpenGL is asked for and does not work here.
    """
    if not isinstance(kind, str):
        return kind(model)
    if kind == "ray":
        return RayRenderer(model)
    if kind == "gl":
        return OpenGlRenderer(model)
    if kind != "auto":
        raise NoSuchName(f"no renderer `{kind}`; choose `auto`, `gl` or `ray`")
    try:
        return OpenGlRenderer(model)
    except InvalidInput:
        return RayRenderer(model)
