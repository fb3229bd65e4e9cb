"""The witness. It records the true scene before a program runs forwards, and again before the program runs backwards.
Only the referee uses these records.
"""

from collections.abc import Iterable
from typing import Final

import mujoco
import numpy as np
from msgspec.structs import replace

from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadFile, Refused
from handeye.core.pose import Array, Pose, pose
from handeye.core.record import Record
from handeye.machines.purbrick import PURBRICK
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.program import TrigProgram

SEEN: Final = "seen"
_ENTRIES: Final = 12  # of a pose: rotation matrix by rows, position


class ObservedScene(Record, frozen=True, kw_only=True):
    """The true scene at one moment."""

    blocks: dict[str, tuple[float, ...]]
    """Poses of the blocks relative to the platter, lower blocks first. Each pose consists of the three rows of a
    rotation matrix, followed by the position (m).
    """
    hand: tuple[float, ...]  # m and rad

    @property
    def poses(self) -> dict[str, Pose]:
        """Poses of the blocks relative to the platter."""
        return {name: pose(np.array(row[:9]).reshape(3, 3), row[9:]) for name, row in self.blocks.items()}

    @property
    def sound(self) -> bool:
        """True if the record is well formed and all its numbers are finite."""
        rows = [*self.blocks.values()]
        whole = len(self.hand) == len(PURBRICK.axes) and all(len(row) == _ENTRIES for row in rows)
        return whole and all(np.isfinite(row).all() for row in (self.hand, *rows))


class InitialScene(ObservedScene, frozen=True, kw_only=True):
    """The scene before a run. Once the run's reversal has begun, the record also has the scene before the reversal."""

    taught: dict[str, Place]  # taught positions
    turned: ObservedScene | None = None  # scene before the reversal, if recorded

    def place(self, name: str) -> Place:
        """Return a taught position. Raises Refused if the script does not teach the position."""
        found = self.taught.get(name)
        if found is None:
            raise Refused(f"the referee needs the position {name}, which the script does not teach")
        return found


class Witness(Mechanism[InitialScene]):
    """Records the scenes of a job."""

    name = SEEN
    kind = InitialScene

    def __init__(self) -> None:
        self.began = InitialScene(blocks={}, hand=(0.0,) * len(PURBRICK.axes), taught={})

    def look(self, data: mujoco.MjData, names: Iterable[str], program: TrigProgram) -> None:
        """Record the poses of the blocks `names` and of the hand, and the taught positions of a program."""
        now = stands(data, names)
        taught = {name: position.init for name, position in program.positions.items()}
        self.began = InitialScene(blocks=now.blocks, hand=now.hand, taught=taught)

    def turn(self, data: mujoco.MjData) -> None:
        """Record the scene before the reversal."""
        self.began = replace(self.began, turned=stands(data, self.began.blocks))

    def state(self) -> InitialScene:
        return self.began

    def check(self, state: InitialScene) -> None:
        turned = state.turned or state
        alike = {*turned.blocks} == {*state.blocks}
        if not (alike and state.sound and turned.sound and np.isfinite([*state.taught.values()]).all()):
            raise BadFile("the recorded scene before the run is not valid")

    def restore(self, state: InitialScene) -> None:
        self.began = state


def stands(data: mujoco.MjData, names: Iterable[str]) -> ObservedScene:
    poses = block_poses(data, names)
    rows = {name: (*X[:3, :3].ravel().tolist(), *X[:3, 3].tolist()) for name, X in poses.items()}
    return ObservedScene(blocks=rows, hand=tuple(hand(data).tolist()))


def block_poses(data: mujoco.MjData, names: Iterable[str]) -> dict[str, Pose]:
    """Return the true poses of the blocks' centres relative to the platter."""
    platter = data.body("platter").xpos
    return {name: pose(data.body(name).xmat.reshape(3, 3), data.body(name).xpos - platter) for name in names}


def hand(data: mujoco.MjData) -> Array:
    """Return the true place of the hand relative to the platter (m and rad, shape (6,))."""
    return np.array([data.joint(spec.name).qpos[0] for spec in PURBRICK.axes])
