"""Frames of everything in the simulated cell, for the trace: an observer that can change nothing."""

import numpy as np
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from numpy.typing import NDArray

from handeye.cell.looks import LATENT
from handeye.cell.truth import Truth
from handeye.trace.messages import Poses
from handeye.trace.scene import looks, scene

Mask = NDArray[np.bool_]


class Frames:
    """The frames of a cell's bodies. They are those the simulator last computed, a physics step before the tick."""

    def __init__(self, truth: Truth, joints: tuple[str, ...]) -> None:
        """Look at a cell; `joints` are the names of its arm's joints, in order."""
        self._truth = truth
        bodies = range(1, truth.model.nbody)  # body 0 is the world
        self.names = tuple(str(truth.model.body(number).name) for number in bodies)
        self.joints = joints
        self._looks = np.array([next(iter(looks(truth, number)), 0) for number in bodies])

    def poses(self) -> Poses:
        """Pose of each frame now."""
        data = self._truth.data
        return np.concatenate([data.xpos[1:], data.xquat[1:]], axis=1, dtype=np.float32, casting="same_kind")

    def there(self) -> Mask:
        """Which frames belong to bodies that are there now, be they put away or not; shape (n,)."""
        there: Mask = self._truth.model.geom_group[self._looks] != LATENT
        return there

    def scene(self, time: int) -> bytes:
        """Looks of the bodies, as a message; `time` in ns."""
        return scene(self._truth, time)


class NoFrames(Frames):
    """No frames at all: of a system that acts on no cell."""

    def __init__(self) -> None:
        self.names, self.joints = (), ()

    def poses(self) -> Poses:
        return np.empty((0, 7), dtype=np.float32)

    def there(self) -> Mask:
        return np.empty(0, dtype=np.bool_)

    def scene(self, time: int) -> bytes:
        return SceneUpdate().SerializeToString()
