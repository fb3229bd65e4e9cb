"""Adds shapes to a MuJoCo specification: boxes, cylinders, meshes, and holes as rings of convex wedges."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.looks import BOX, CYLINDER, MESH, SPHERE
from handeye.core.pose import Array

Vector = Sequence[float]
_MARK_HALF_HEIGHT_M = 1e-4  # half the height of the disc that marks a hole


@dataclass(frozen=True, slots=True, kw_only=True)
class Bore:
    """A round hole along z, from z = 0 to `height`, in metal that extends to radius `outer`. All lengths are in
    m.

    The collision shape is a ring of convex wedges whose inscribed circle has `radius`, so the hole is never
    narrower than specified. The wedges also form the 45 degree chamfers at the upper (`above`) and lower
    (`below`) ends of the hole.
    """

    radius: float
    outer: float
    height: float
    above: float = 0.0
    below: float = 0.0
    sectors: int = 12

    def wedge(self) -> Array:
        """Return the corners of the wedge that lies on the x axis (m, shape (n, 3))."""
        profile = [(self.outer, 0.0), (self.radius + self.below, 0.0), (self.radius, self.below)]
        profile += [(self.radius, self.height - self.above), (self.radius + self.above, self.height)]
        profile += [(self.outer, self.height)]
        half = math.tan(math.pi / self.sectors)
        return np.array([(r, side * r * half, z) for side in (-1, 1) for r, z in dict.fromkeys(profile)])


@dataclass(frozen=True, slots=True, kw_only=True)
class Shaper:
    """Adds geoms to a specification, using its default classes."""

    spec: mujoco.MjSpec

    def style(self, name: str) -> mujoco.MjsDefault:
        """Return the default class called `name`."""
        style = self.spec.find_default(name)
        assert style is not None, name
        return style

    def box(
        self,
        body: mujoco.MjsBody,
        style: str,
        low: Vector,
        high: Vector,
        material: str | None = None,
        name: str = "",
    ) -> mujoco.MjsGeom:
        """Add an upright box between two opposite corners (m)."""
        lower, upper = np.asarray(low, float), np.asarray(high, float)
        geom = body.add_geom(self.style(style), type=BOX, pos=(lower + upper) / 2, size=(upper - lower) / 2)
        return _named(geom, name, material)

    def ball(self, body: mujoco.MjsBody, style: str, radius: float, centre: Vector) -> mujoco.MjsGeom:
        """Add a ball with a radius (m) and a centre (m)."""
        return body.add_geom(self.style(style), type=SPHERE, size=[radius, 0.0, 0.0], pos=centre)

    def cylinder(
        self, body: mujoco.MjsBody, style: str, radius: float, start: Vector, end: Vector,
        material: str | None = None, name: str = "",
    ) -> mujoco.MjsGeom:  # fmt: skip
        """Add a cylinder with a radius (m) between two points on its axis (m)."""
        geom = body.add_geom(self.style(style), type=CYLINDER, fromto=[*start, *end], size=[radius, 0.0, 0.0])
        return _named(geom, name, material)

    def convex(self, name: str, points: Array) -> str:
        """Add the convex hull of `points` (m, shape (n, 3)) as a mesh asset for collisions. Returns the name of the
        asset.
        """
        self.spec.add_mesh(name=name, uservert=points.ravel().tolist())
        return name

    def ring(
        self,
        body: mujoco.MjsBody,
        mesh: str,
        bore: Bore,
        at: Vector,
        style: Callable[[float], str],
    ) -> list[mujoco.MjsGeom]:
        """Add the wedges that surround a bore whose axis passes through `at` (m). `style` takes the direction of a
        wedge (rad) and returns the name of its MuJoCo default class.
        """
        if self.spec.mesh(mesh) is None:
            self.convex(mesh, bore.wedge())
        wedges = []
        for k in range(bore.sectors):
            angle = 2 * math.pi * k / bore.sectors
            turn = [math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2)]
            wedges.append(
                body.add_geom(self.style(style(angle)), type=MESH, meshname=mesh, pos=at, quat=turn)
            )
        return wedges

    def group(self, body: mujoco.MjsBody, shapes: str) -> mujoco.MjsBody:
        """Add a separate body for the bores of a part, or for its lands (the small raised faces on which the part
        rests). The body is fixed to the part.

        The simulator first searches for contacts between bodies, then between their shapes. Two stacked parts touch
        only at their lands, and only fasteners touch the many wedges of bores. If lands and bores are in bodies of
        their own, the simulator therefore skips most shapes of the parts.
        """
        return body.add_body(name=f"{body.name}_{shapes}")

    def hole(self, body: mujoco.MjsBody, name: str, mouth: Vector, radius: float) -> None:
        """Mark a hole with a site at its mouth. `mouth` is the centre of the hole in the upper face (m). The first
        size of the site is the radius of the hole.
        """
        body.add_site(name=name, type=CYLINDER, pos=mouth, size=[radius, _MARK_HALF_HEIGHT_M, 0.0], group=5)

    def look(
        self, body: mujoco.MjsBody, name: str, material: str, surface: tuple[Array, NDArray[np.int32]],
        at: Vector = (0.0, 0.0, 0.0), style: str = "look",
    ) -> mujoco.MjsGeom:  # fmt: skip
        """Add a surface that is visible, but collides with nothing. The surface is given by vertices (m, shape (n, 3))
        and triangles (shape (m, 3)). A surface of style `scenery` appears only in photographs.
        """
        if self.spec.mesh(name) is None:
            self.spec.add_mesh(
                name=name,
                uservert=surface[0].ravel().tolist(),
                userface=surface[1].ravel().tolist(),
                inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
            )
        geom = body.add_geom(self.style(style), type=MESH, meshname=name, pos=at)
        geom.material = material
        return geom


def _named(geom: mujoco.MjsGeom, name: str, material: str | None) -> mujoco.MjsGeom:
    if name:
        geom.name = name
    if material is not None:
        geom.material = material
    return geom


def body_inertia(body: mujoco.MjsBody, mass: float, centre: Vector, moments: Vector) -> None:
    """Set the mass (kg), centre of mass (m) and principal moments of inertia (kg m2) of a body. MuJoCo then does not
    compute these values from the body's geoms.
    """
    body.explicitinertial = True
    body.mass = mass
    body.ipos[:] = centre
    body.inertia[:] = moments


def box_moments(mass: float, size: Vector) -> list[float]:
    """Return the principal moments of inertia (kg m2) of a uniform box with a mass (kg) and full lengths `size`
    (m)."""
    x, y, z = size
    return [mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12]


def towards(view: Array) -> list[float]:
    """Return the quaternion of a frame whose -z axis points along `view` and whose x axis is horizontal."""
    z = -view / np.linalg.norm(view)
    x = np.cross((0.0, 0.0, 1.0), z)
    x /= np.linalg.norm(x)
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, np.column_stack([x, np.cross(z, x), z]).ravel())
    return [float(value) for value in quat]


def add_camera(spec: mujoco.MjSpec, name: str, eye: Array, at: Array) -> mujoco.MjsCamera:
    """Add an upright camera at `eye` (m) that looks at the point `at` (m)."""
    return spec.worldbody.add_camera(name=name, pos=eye.tolist(), quat=towards(at - eye))
