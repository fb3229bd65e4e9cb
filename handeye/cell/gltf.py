"""A scene as a glTF file (GLB): a tree of named bodies, their solids, and places on them.

glTF has y up and linear colours, and both are given so. Grain and gloss are left out.
"""

from collections.abc import Collection, Mapping
from typing import Final

import mujoco
import numpy as np
import trimesh
from trimesh.visual import ColorVisuals, TextureVisuals
from trimesh.visual.material import PBRMaterial

from handeye.cell.keyframe import body_pose
from handeye.cell.solids import Solid, SolidScene
from handeye.core.pose import Array, inverse, pose

FRAME: Final = "scene"  # the node of the world frame, z up
_OUTSIDE: Final = "world"  # name of a file's frame in trimesh
_Y_UP: Final = trimesh.transformations.rotation_matrix(-np.pi / 2, (1.0, 0.0, 0.0))
_ROUGH: Final = 0.7


def glb(scene: SolidScene, told: Mapping[str, str]) -> bytes:
    """A scene as it stands, as a GLB file; `told` are texts for the `extras` of the scene, by name."""
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
            if site.name not in tree.graph.nodes:  # else a body has its name
                place = data.site(site.name)
                X_WP = pose(place.xmat.reshape(3, 3).copy(), place.xpos.copy())
                tree.graph.update(frame_from=node, frame_to=site.name, matrix=inverse(around) @ X_WP)
    file = tree.export(file_type="glb")
    assert isinstance(file, bytes)
    return file


def _node(tree: trimesh.Scene, body: mujoco.MjsBody, data: mujoco.MjData, bodies: Collection[str]) -> str:
    """The node of a body, which hangs on that of the body around it, if that is there."""
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
