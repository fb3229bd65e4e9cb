"""Provides the trace with the poses of all bodies in the simulated cell, without changing the cell."""

import numpy as np
from foxglove_schemas_protobuf.Color_pb2 import Color
from foxglove_schemas_protobuf.Point3_pb2 import Point3
from foxglove_schemas_protobuf.Pose_pb2 import Pose
from foxglove_schemas_protobuf.Quaternion_pb2 import Quaternion
from foxglove_schemas_protobuf.SceneEntity_pb2 import SceneEntity
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from foxglove_schemas_protobuf.Vector3_pb2 import Vector3
from numpy.typing import NDArray

from handeye.cell.looks import BOX, CYLINDER, LATENT, MESH, SEEN
from handeye.cell.truth import Truth
from handeye.core.pose import Array
from handeye.trace.channels import WORLD
from handeye.trace.messages import Poses, stamp


def looks(truth: Truth, body: int) -> list[int]:
    """Return the geoms of a body that are visible, or that will become visible after an event."""
    mine = np.flatnonzero(truth.model.geom_bodyid == body)
    return [int(shape) for shape in mine if truth.drawn.geom_group[shape] in (SEEN, LATENT)]


def scene(truth: Truth, time: int) -> bytes:
    """Encode all visible bodies at the start of a run. The shapes of each body are given in the body's frame;
    `time` is in ns.
    """
    entities = []
    for body in range(truth.model.nbody):
        name = truth.model.body(body).name if body else WORLD
        entity = SceneEntity(timestamp=stamp(time), frame_id=name, id=name, frame_locked=True)
        for shape in looks(truth, body):
            _add(entity, truth, shape)
        entities.append(entity)
    return SceneUpdate(entities=entities).SerializeToString()


def _add(entity: SceneEntity, truth: Truth, shape: int) -> None:
    """Add a shape to its body's entity. A ball is left out, because the only ball is the lamp."""
    model = truth.model
    material = model.geom_matid[shape]
    r, g, b, a = _short(truth.drawn.mat_rgba[material] if material >= 0 else model.geom_rgba[shape])
    qw, qx, qy, qz = _short(model.geom_quat[shape])
    pose = Pose(position=_vector(model.geom_pos[shape]), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw))
    color, size, kind = Color(r=r, g=g, b=b, a=a), model.geom_size[shape], model.geom_type[shape]
    if kind == BOX:
        entity.cubes.add(pose=pose, size=_vector(2 * size), color=color)
    elif kind == CYLINDER:
        across, along = 2 * size[0], 2 * size[1]
        upright = _vector(np.array([across, across, along]))
        entity.cylinders.add(pose=pose, size=upright, bottom_scale=1.0, top_scale=1.0, color=color)
    elif kind == MESH:
        mesh = model.geom_dataid[shape]
        first, corner = model.mesh_vertadr[mesh], model.mesh_faceadr[mesh]
        points = model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
        corners = model.mesh_face[corner : corner + model.mesh_facenum[mesh]]
        entity.triangles.add(
            pose=pose,
            points=[Point3(x=x, y=y, z=z) for x, y, z in points.tolist()],
            indices=corners.ravel().tolist(),
            color=color,
        )


def _short(values: Array) -> list[float]:
    """Return the numbers rounded to seven digits, to keep files small."""
    return [float(value) for value in values.astype(np.float32)]


def _vector(values: Array) -> Vector3:
    x, y, z = _short(values)
    return Vector3(x=x, y=y, z=z)


Mask = NDArray[np.bool_]


class Frames:
    """The poses of a cell's bodies one physics step before the present tick. These are the latest poses that the
    simulator has computed.
    """

    def __init__(self, truth: Truth, joints: tuple[str, ...]) -> None:
        """Observe a cell. `joints` are the names of the arm's joints, in the order of the arm."""
        self._truth = truth
        bodies = range(1, truth.model.nbody)  # body 0 is the world
        self.names = tuple(str(truth.model.body(number).name) for number in bodies)
        self.joints = joints
        self._looks = np.array([next(iter(looks(truth, number)), 0) for number in bodies])

    def poses(self) -> Poses:
        data = self._truth.data
        return np.concatenate([data.xpos[1:], data.xquat[1:]], axis=1, dtype=np.float32, casting="same_kind")

    def there(self) -> Mask:
        """Return a mask, shape (n,). Some bodies appear only after an event; before this event, the mask is False for
        them. The mask is True for all other bodies, even if they are put away.
        """
        there: Mask = self._truth.model.geom_group[self._looks] != LATENT
        return there

    def scene(self, time: int) -> bytes:
        """Encode the bodies of the scene as a message; `time` is in ns."""
        return scene(self._truth, time)


class NoFrames(Frames):
    """Provides no poses, for a system without a cell."""

    def __init__(self) -> None:
        self.names, self.joints = (), ()

    def poses(self) -> Poses:
        return np.empty((0, 7), dtype=np.float32)

    def there(self) -> Mask:
        return np.empty(0, dtype=np.bool_)

    def scene(self, time: int) -> bytes:
        return SceneUpdate().SerializeToString()
