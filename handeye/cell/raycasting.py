"""Pictures by ray casting: the same on every computer, and without OpenGL."""

from typing import Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.rendering import FINE, LUMA, SHOWN, SceneRenderer, averaged
from handeye.cell.vidicon import Luminance
from handeye.core.pose import Array
from handeye.ports.camera import COLUMNS, ROWS, Renderer
from handeye.vision.camera_model import View

SKY: Final = 0.1
"""Luminance of the background, where no object is visible. Placeholder."""


class RayRenderer(SceneRenderer):
    """Casts a ray for every sample, and from the point it hits a ray to every light, for the shadows. Needs no
    OpenGL.
    """

    identity = Renderer(method="rays")

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        v, u = np.mgrid[0 : ROWS * FINE, 0 : COLUMNS * FINE]
        self._samples = (np.column_stack([u.ravel(), v.ravel()]) + 0.5) / FINE - 0.5

    def render(self, data: mujoco.MjData, view: View) -> Luminance:
        model = self._model
        albedo, glow = _reflectance(model)  # again: the lamp may have been switched on
        eye = view.X_WC[:3, 3]
        rays = view.rays(self._samples)
        rays /= np.linalg.norm(rays, axis=1, keepdims=True)
        geom, distance, normal = cast(model, data, eye, rays)
        hit = geom >= 0
        points = eye + rays[hit] * distance[hit, None]
        normals = normal[hit] * -np.sign(np.sum(normal[hit] * rays[hit], axis=1, keepdims=True))
        light = np.full(len(points), ambient(model))
        for index in range(model.nlight):
            if model.light_active[index]:
                light += self._light(data, index, points, normals)
        result = np.full(len(rays), SKY)
        result[hit] = np.clip(albedo[geom[hit]] * light + glow[geom[hit]], 0, 1)
        return averaged(result.reshape(ROWS * FINE, COLUMNS * FINE))

    def _light(self, data: mujoco.MjData, index: int, points: Array, normals: Array) -> Array:
        """Return the light of one lamp on surface points, shape (n,)."""
        model = self._model
        source, axis = data.light_xpos[index], data.light_xdir[index]
        directional = model.light_type[index] == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        if directional:  # as good as parallel from 100 m, and the shadow is again a cast from one point
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
            amount[lit] *= met > far[lit] - 5e-4  # half a millimetre: a surface is not in its own shadow
        return np.asarray(amount + float(LUMA @ model.light_ambient[index]))


def cast(
    model: mujoco.MjModel, data: mujoco.MjData, origin: Array, rays: Array
) -> tuple[NDArray[np.int32], Array, Array]:
    """Cast rays along unit vectors, shape (n, 3). Returns the geom hit or -1, shape (n,); the distance (m), shape
    (n,); and the normal, shape (n, 3).
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


def ambient(model: mujoco.MjModel) -> float:
    """Return the ambient light. The rest of MuJoCo's headlight is meant for interactive viewers and does not appear
    in pictures.
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
