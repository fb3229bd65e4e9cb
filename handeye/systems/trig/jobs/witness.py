"""Witness: how everything stood before a program was run and before it was undone; for the referee alone."""

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
"""Its name."""
_ENTRIES: Final = 12
"""Numbers of a pose: a rotation matrix by rows, and a place."""


class Stood(Record, frozen=True, kw_only=True):
    """How it stood at a moment."""

    blocks: dict[str, tuple[float, ...]]
    """Poses over the platter by the names of the blocks, those below first: three rows of a rotation matrix, and m."""
    hand: tuple[float, ...]
    """Where the hand truly was, m and rad."""

    @property
    def poses(self) -> dict[str, Pose]:
        """Poses of the blocks over the platter."""
        return {name: pose(np.array(row[:9]).reshape(3, 3), row[9:]) for name, row in self.blocks.items()}

    @property
    def sound(self) -> bool:
        """It can be so."""
        rows = [*self.blocks.values()]
        whole = len(self.hand) == len(PURBRICK.axes) and all(len(row) == _ENTRIES for row in rows)
        return whole and all(np.isfinite(row).all() for row in (self.hand, *rows))


class Began(Stood, frozen=True, kw_only=True):
    """How it stood before the program was run, and since then where it was about to be undone."""

    taught: dict[str, Place]
    """Positions as somebody has taught them."""
    turned: Stood | None = None
    """How it stood when the job was about to be undone; None: nobody has looked."""

    def place(self, name: str) -> Place:
        """A position as somebody has taught it.

        Raises:
            InvalidInput: nobody has.
        """
        found = self.taught.get(name)
        if found is None:
            raise Refused(f"the referee looks for the position {name}, which the script does not teach")
        return found


class Witness(Mechanism[Began]):
    """Remembers how it stood."""

    name = SEEN
    kind = Began

    def __init__(self) -> None:
        self.began = Began(blocks={}, hand=(0.0,) * len(PURBRICK.axes), taught={})

    def look(self, data: mujoco.MjData, names: Iterable[str], program: TrigProgram) -> None:
        """Remember how it stands now: blocks of these names, and the places of a program."""
        now = stands(data, names)
        taught = {name: position.init for name, position in program.positions.items()}
        self.began = Began(blocks=now.blocks, hand=now.hand, taught=taught)

    def turn(self, data: mujoco.MjData) -> None:
        """Remember how it stands now, where it is about to be undone."""
        self.began = replace(self.began, turned=stands(data, self.began.blocks))

    def state(self) -> Began:
        return self.began

    def check(self, state: Began) -> None:
        turned = state.turned or state
        alike = {*turned.blocks} == {*state.blocks}
        if not (alike and state.sound and turned.sound and np.isfinite([*state.taught.values()]).all()):
            raise BadFile("what was seen before the program was run is no place")

    def restore(self, state: Began) -> None:
        self.began = state


def stands(data: mujoco.MjData, names: Iterable[str]) -> Stood:
    """The truth: how it stands now."""
    poses = block_poses(data, names)
    rows = {name: (*X[:3, :3].ravel().tolist(), *X[:3, 3].tolist()) for name, X in poses.items()}
    return Stood(blocks=rows, hand=tuple(hand(data).tolist()))


def block_poses(data: mujoco.MjData, names: Iterable[str]) -> dict[str, Pose]:
    """The truth: poses of blocks' middles over the platter."""
    platter = data.body("platter").xpos
    return {name: pose(data.body(name).xmat.reshape(3, 3), data.body(name).xpos - platter) for name in names}


def hand(data: mujoco.MjData) -> Array:
    """The truth: where the hand is over the platter, shape (6,)."""
    return np.array([data.joint(spec.name).qpos[0] for spec in PURBRICK.axes])
