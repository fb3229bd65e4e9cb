"""Pictures by ray casting: the same on every computer, and without OpenGL."""

from typing import Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.rendering import FINE, LUMA, SHOWN, SceneRenderer
from handeye.cell.vidicon import Luminance
from handeye.core.pose import Array
from handeye.ports.camera import COLUMNS, ROWS, Renderer
from handeye.vision.camera_model import View

SKY: Final = 0.1
"""Luminance of the background, where no object is visible. Placeholder."""
_SMOOTH: Final = 1 / 64
"""If the luminance of neighbouring points differs by at most this value, one sample of each point is enough. The value
is a quarter of a grey level.
"""
_SAMPLES: Final = (np.indices((FINE, FINE)).reshape(2, -1).T[:, ::-1] + 0.5) / FINE - 0.5
"""Offsets (u, v) of the samples of a picture point from the middle of this point."""


class RayRenderer(SceneRenderer):
    """Casts a ray for every sample. To find the shadows, the renderer then casts rays to all lights from the point
    that the first ray hits. Needs no OpenGL.

    A picture point has one sample, or four if it lies where the picture changes: at edges of solids and of shadows
    (adaptive sampling after T. Whitted, "An improved illumination model for shaded display", 1980).
    """

    identity = Renderer(method="rays")

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        v, u = np.mgrid[0:ROWS, 0:COLUMNS]
        self._points = np.column_stack([u.ravel(), v.ravel()]).astype(np.float64)

    def render(self, data: mujoco.MjData, view: View) -> Luminance:
        middle, geom = self._sampled(data, view, self._points)
        result = middle.reshape(ROWS, COLUMNS)
        rough = _edges(geom.reshape(ROWS, COLUMNS), result)
        points = (self._points[rough.ravel(), None] + _SAMPLES).reshape(-1, 2)
        result[rough] = self._sampled(data, view, points)[0].reshape(-1, len(_SAMPLES)).mean(axis=1)
        return result.astype(np.float32)

    def _sampled(self, data: mujoco.MjData, view: View, points: Array) -> tuple[Array, NDArray[np.int32]]:
        """Return luminance and geom, each of shape (n,), at picture points (u, v), shape (n, 2). The geom is -1
        where no shape is visible.
        """
        model = self._model
        albedo, glow = _reflectance(model)  # again: the lamp may have been switched on
        eye = view.X_WC[:3, 3]
        rays = view.rays(points)
        rays /= np.linalg.norm(rays, axis=1, keepdims=True)
        geom, distance, normal = cast(model, data, eye, rays)
        hit = geom >= 0
        surface = eye + rays[hit] * distance[hit, None]
        normals = normal[hit] * -np.sign(np.sum(normal[hit] * rays[hit], axis=1, keepdims=True))
        light = np.full(len(surface), ambient(model))
        for index in range(model.nlight):
            if model.light_active[index]:
                light += self._light(data, index, surface, normals)
        luminance = np.full(len(rays), SKY)
        luminance[hit] = np.clip(albedo[geom[hit]] * light + glow[geom[hit]], 0, 1)
        return luminance, geom

    def _light(self, data: mujoco.MjData, index: int, points: Array, normals: Array) -> Array:
        """Return the amount of light that surface points receive from one lamp, shape (n,)."""
        model = self._model
        source, axis = data.light_xpos[index], data.light_xdir[index]
        directional = model.light_type[index] == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        if directional:  # rays from 100 m away are almost parallel, and all of them come from one point
            source = points.mean(axis=0) - 100 * axis
        towards = source - points
        far = np.linalg.norm(towards, axis=1)
        towards /= far[:, None]
        amount = float(LUMA @ model.light_diffuse[index]) * np.clip(np.sum(normals * towards, axis=1), 0, 1)
        if not directional:
            cosine = -towards @ axis
            inside = cosine >= np.cos(np.radians(model.light_cutoff[index]))
            amount *= np.where(inside, np.clip(cosine, 0, 1) ** model.light_exponent[index], 0)
        lit = amount > 0
        if self.shadows and model.light_castshadow[index]:
            _, met, _ = cast(model, data, source, -towards[lit])
            amount[lit] *= met > far[lit] - 5e-4  # half a millimetre, so that a surface does not shade itself
        return np.asarray(amount + float(LUMA @ model.light_ambient[index]))


def cast(
    model: mujoco.MjModel, data: mujoco.MjData, origin: Array, rays: Array
) -> tuple[NDArray[np.int32], Array, Array]:
    """Cast rays along unit vectors, shape (n, 3). Returns three arrays with a row for each ray: the geom that the ray
    hits, or -1 if it hits none, shape (n,); the distance (m) of this geom, shape (n,); and the normal of the surface,
    shape (n, 3).
    """
    n = len(rays)
    geom, distance, normal = np.full(n, -1, dtype=np.int32), np.zeros(n), np.zeros(3 * n)
    if n:
        mujoco.mj_multiRay(
            m=model,
            d=data,
            pnt=np.array(origin, dtype=np.float64),
            vec=np.ascontiguousarray(rays).reshape(-1),
            geomgroup=SHOWN,
            flg_static=True,
            bodyexclude=-1,
            geomid=geom,
            dist=distance,
            normal=normal,
            nray=n,
            cutoff=1e3,
        )
    return geom, distance, normal.reshape(-1, 3)


def _edges(geom: NDArray[np.int32], luminance: Array) -> NDArray[np.bool_]:
    """Return a mask in the shape of the picture. The mask is True at the edges in the picture: at both points of each
    pair of neighbours whose geoms or luminances differ.
    """
    rough = np.zeros(geom.shape, dtype=bool)
    for a, b in (
        ((slice(1, None), slice(None)), (slice(-1), slice(None))),
        ((slice(None), slice(1, None)), (slice(None), slice(-1))),
    ):
        differ = (geom[a] != geom[b]) | (np.abs(luminance[a] - luminance[b]) > _SMOOTH)
        rough[a] |= differ
        rough[b] |= differ
    return rough


def ambient(model: mujoco.MjModel) -> float:
    """Return the luminance of the ambient part of MuJoCo's headlight. The rest of the headlight is meant for
    interactive viewers and does not appear in pictures.
    """
    head = model.vis.headlight
    return float(LUMA @ head.ambient) if head.active else 0.0


def _reflectance(model: mujoco.MjModel) -> tuple[Array, Array]:
    """Return the luminance that each geom reflects and emits, shape (ngeom,). The colour of a geom takes precedence
    over its material.
    """
    rgba = np.array(model.geom_rgba)
    material = np.array(model.geom_matid)
    plain = (material >= 0) & np.all(np.isclose(rgba, [0.5, 0.5, 0.5, 1.0]), axis=1)
    rgba[plain] = model.mat_rgba[material[plain]]
    emission = np.zeros(len(rgba))
    emission[material >= 0] = model.mat_emission[material[material >= 0]]
    albedo = rgba[:, :3] @ LUMA
    return albedo, albedo * emission
