"""Converts the solids of a scene to trimesh meshes, each with its name, and writes the scene as a glTF file (GLB) that
contains these solids.

A solid is a coloured surface with a mass. A solid also records whether its surface is closed. If a surface consists of
several coloured pieces in the scene, these pieces form one solid. A surface is closed only if neighbouring faces share
their corners, so each corner has only one colour. Where two colours meet, the corners get the lighter colour.

The file has a tree of named bodies. Each body has its solids, and named places on the body. In glTF, y points up and
colours are linear, so axes and colours are converted. Grain and gloss are left out.
"""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Self

import mujoco
import numpy as np
import trimesh
from trimesh.visual import ColorVisuals, TextureVisuals
from trimesh.visual.material import PBRMaterial

from handeye.cell.keyframe import body_pose
from handeye.cell.looks import BOX, CYLINDER, MESH, SCENERY, SEEN, SPHERE
from handeye.cell.mjcf import mesh_of
from handeye.core.pose import Array, Pose, inverse, pose

SIDES: Final = 64  # sides of the prism that stands for a cylinder
_RGB: Final = int(mujoco.mjtTextureRole.mjTEXROLE_RGB)


@dataclass(frozen=True, slots=True, kw_only=True)
class Solid:
    """A solid of a body."""

    name: str  # unique in its body
    mesh: str | None  # name of its shape, which other solids may have too
    shape: trimesh.Trimesh  # in its own frame, in m
    X_BS: Pose
    colours: Array
    """Red, green, blue and opacity, as screen values, for each corner, shape (n, 4), or for the whole solid, shape
    (4,).
    """


def placed(solid: Solid) -> trimesh.Trimesh:
    """Return the shape of a solid in the frame of its body."""
    shape: trimesh.Trimesh = solid.shape.copy()
    shape.apply_transform(solid.X_BS)
    return shape


def solids_of(spec: mujoco.MjSpec, model: mujoco.MjModel, body: mujoco.MjsBody) -> Iterator[Solid]:
    """Yield the solids that make a body visible."""
    pieces: list[tuple[mujoco.MjsGeom, trimesh.Trimesh, Array]] = []
    named: Counter[str] = Counter()
    for number, geom in enumerate(geom for geom in body.geoms if geom.group in (SEEN, SCENERY)):
        if geom.type != MESH:
            yield _primitive(model, geom, geom.name or f"shape{number}")
            continue
        shape, mesh = mesh_of(spec.mesh(geom.meshname)), geom.meshname
        if shape.is_watertight:
            yield _mesh(geom, mesh, shape, _colour(model, geom), again=named[mesh])
            named[mesh] += 1
        else:
            pieces.append((geom, shape, _colour(model, geom)))
    if pieces:
        first = pieces[0][0]
        name = first.meshname.rpartition("_")[0]  # the colour comes after it
        yield _mesh(first, name, *_joined([piece[1:] for piece in pieces]), again=0)


def _primitive(model: mujoco.MjModel, geom: mujoco.MjsGeom, name: str) -> Solid:
    size = model.geom_size[geom.id]
    if geom.type == BOX:
        shape = trimesh.creation.box(extents=2 * size)
    elif geom.type == CYLINDER:
        shape = trimesh.creation.cylinder(radius=size[0], height=2 * size[1], sections=SIDES)
    else:
        assert geom.type == SPHERE, geom.type
        shape = trimesh.creation.icosphere(radius=size[0])
    X_BS = _pose(model.geom_quat[geom.id], model.geom_pos[geom.id])
    return Solid(name=name, mesh=None, shape=shape, X_BS=X_BS, colours=_colour(model, geom))


def _mesh(geom: mujoco.MjsGeom, mesh: str, shape: trimesh.Trimesh, colours: Array, *, again: int) -> Solid:
    """Make a solid from a mesh. `again` is the number of times that the body has already used this mesh."""
    name = f"{mesh}{again}" if again else mesh
    return Solid(name=name, mesh=mesh, shape=shape, X_BS=_pose(geom.quat, geom.pos), colours=colours)


def _joined(pieces: Sequence[tuple[trimesh.Trimesh, Array]]) -> tuple[trimesh.Trimesh, Array]:
    """Join pieces, each of one colour, to form one surface. Returns the surface, and the colours of its corners."""
    loose = trimesh.util.concatenate([shape for shape, _ in pieces])
    assert isinstance(loose, trimesh.Trimesh)
    painted = np.concatenate([np.tile(colour, (len(shape.vertices), 1)) for shape, colour in pieces])
    corners, number = np.unique(loose.vertices, axis=0, return_inverse=True)
    colours = np.zeros((len(corners), 4))
    np.maximum.at(colours, number, painted)
    return trimesh.Trimesh(corners, number[loose.faces], process=False), colours


def _colour(model: mujoco.MjModel, geom: mujoco.MjsGeom) -> Array:
    """Return the mean colour of a shape: the colour of its material, multiplied by the mean of its grain."""
    material = int(model.geom_matid[geom.id])
    if material < 0:
        return np.array(model.geom_rgba[geom.id], dtype=float)
    colour, grain = np.array(model.mat_rgba[material], dtype=float), int(model.mat_texid[material, _RGB])
    if grain >= 0:
        first, points = model.tex_adr[grain], model.tex_width[grain] * model.tex_height[grain]
        pixels = model.tex_data[first : first + 3 * points].reshape(-1, 3)
        colour[:3] *= pixels.mean(axis=0) / 255
    return colour


def _pose(quat: Array, place: Array) -> Pose:
    R = np.empty(9)
    mujoco.mju_quat2Mat(R, quat)
    return pose(R.reshape(3, 3), place)


@dataclass(frozen=True, slots=True, kw_only=True)
class WeighedBody:
    """The mass of a body of solid metal, as computed from its volume and as given in the model."""

    body: str
    mass: float  # by volume and density, in kg
    mass_there: float  # in the scene, in kg


@dataclass(frozen=True, slots=True, kw_only=True)
class SolidScene:
    """Bodies of a scene with their solids."""

    spec: mujoco.MjSpec
    model: mujoco.MjModel  # the specification, compiled
    bodies: Mapping[str, tuple[Solid, ...]]  # the solids of each body, with the name that it has in the scene

    @classmethod
    def of(cls, spec: mujoco.MjSpec, wanted: Collection[str] | None) -> Self:
        """Collect the solids of the wanted bodies or, if `wanted` is None, of all bodies, including the scenery fixed
        in the world.
        """
        model = spec.compile()
        bodies = [body for body in spec.bodies if wanted is None or body.name in wanted]
        return cls(
            spec=spec, model=model, bodies={body.name: tuple(solids_of(spec, model, body)) for body in bodies}
        )

    @property
    def open(self) -> tuple[str, ...]:
        """Names of the solids whose surface is not closed."""
        found = (solid for body in self.bodies.values() for solid in body if not solid.shape.is_watertight)
        return tuple(dict.fromkeys(solid.name for solid in found))

    def weighed(self, densities: Mapping[str, float]) -> Iterator[WeighedBody]:
        """Yield the masses of those bodies whose solids all have a density. `densities` (kg/m3) has the names of
        solids as keys.
        """
        for name, body in self.bodies.items():
            if body and all(solid.name in densities for solid in body):
                mass = float(self.model.body(name).mass[0])
                yield WeighedBody(body=name, mass=_mass(body, densities), mass_there=mass)


def _mass(body: Sequence[Solid], densities: Mapping[str, float]) -> float:
    """Return the mass (kg) of solids, computed from their volumes. A volume shared by two solids of equal density
    counts once.
    """
    total = 0.0
    for density in sorted({densities[solid.name] for solid in body}):
        shapes = [placed(solid) for solid in body if densities[solid.name] == density]
        total += density * float(trimesh.boolean.union(shapes).volume)
    return total


FRAME: Final = "scene"  # the node of the world frame, z up
_OUTSIDE: Final = "world"  # name of a file's frame in trimesh
_Y_UP: Final = trimesh.transformations.rotation_matrix(-np.pi / 2, (1.0, 0.0, 0.0))
_ROUGH: Final = 0.7


def glb(scene: SolidScene, told: Mapping[str, str]) -> bytes:
    """Write a scene in its present state as a GLB file. `told` maps names to texts; the file contains them as the
    `extras` of the scene.
    """
    data = mujoco.MjData(scene.model)
    mujoco.mj_forward(scene.model, data)
    tree = trimesh.Scene(base_frame=_OUTSIDE, metadata=dict(told))
    tree.graph.update(frame_from=_OUTSIDE, frame_to=FRAME, matrix=_Y_UP)
    for name, solids in scene.bodies.items():
        body = scene.spec.body(name)
        node = _node(tree, body, data, scene.bodies)
        for solid in solids:
            _hang(tree, node, name, solid)
        around = pose(np.eye(3), np.zeros(3)) if node == FRAME else body_pose(data, node)
        for site in body.sites:
            if site.name not in tree.graph.nodes:  # otherwise a body already has this name
                place = data.site(site.name)
                X_WP = pose(place.xmat.reshape(3, 3).copy(), place.xpos.copy())
                tree.graph.update(frame_from=node, frame_to=site.name, matrix=inverse(around) @ X_WP)
    file = tree.export(file_type="glb")
    assert isinstance(file, bytes)
    return file


def _node(tree: trimesh.Scene, body: mujoco.MjsBody, data: mujoco.MjData, bodies: Collection[str]) -> str:
    """Return the name of the node of a body. If the node of the parent body is in the tree, the new node is attached
    to that node.
    """
    around = body.parent
    if around is None:
        return FRAME
    while around.name not in bodies and around.parent is not None:
        around = around.parent
    X = inverse(body_pose(data, around.name)) @ body_pose(data, body.name)
    on = FRAME if around.parent is None else around.name
    tree.graph.update(frame_from=on, frame_to=body.name, matrix=X)
    return body.name


def _hang(tree: trimesh.Scene, node: str, body: str, solid: Solid) -> None:
    name = f"{body}/{solid.name}"
    geometry = solid.mesh or name
    if geometry not in tree.geometry:
        shape = solid.shape.copy()
        shape.metadata.clear()
        shape.visual = _looks(shape, solid.colours)
        tree.geometry[geometry] = shape
    tree.graph.update(frame_from=node, frame_to=name, matrix=solid.X_BS, geometry=geometry)


def _looks(shape: trimesh.Trimesh, colours: Array) -> ColorVisuals | TextureVisuals:
    linear = np.array(colours)
    screen = linear[..., :3]
    linear[..., :3] = np.where(screen <= 0.04045, screen / 12.92, ((screen + 0.055) / 1.055) ** 2.4)  # sRGB
    painted = np.rint(255 * linear).astype(np.uint8)
    if painted.ndim == 2:
        return ColorVisuals(shape, vertex_colors=painted)
    material = PBRMaterial(baseColorFactor=painted, metallicFactor=0.0, roughnessFactor=_ROUGH)
    return TextureVisuals(material=material)
