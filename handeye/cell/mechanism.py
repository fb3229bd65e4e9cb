"""A part of a simulated cell that acts as time passes: a device, or anything that a task adds to the physics."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from typing import ClassVar, Generic, TypeVar

import msgspec
import mujoco

from handeye.core.errors import BadArgument, Refused

S = TypeVar("S", bound=msgspec.Struct)


@contextmanager
def scene_for(what: str) -> Iterator[None]:
    """In this context, a name missing in the scene raises BadArgument with a sentence, instead of KeyError."""
    try:
        yield
    except KeyError as error:
        raise BadArgument(f"{what} cannot work in this scene: {error.args[0]}") from None


class Mechanism(ABC, Generic[S]):
    """A part of a cell that acts on the simulator before time passes, and may read it afterwards."""

    name: str  # by which its state is found
    kind: type[S]  # the type of its state
    changes: ClassVar[tuple[str, ...]] = ()
    """Fields of the MuJoCo model that the mechanism changes as it runs; they belong to the state of the cell."""

    def begin_stage(self, number: int) -> None:
        """Apply the effects due at a stage of the program, given by its number from 1, or at an earlier stage."""

    def before(self, seconds: float) -> None:
        """Prepare for the next `seconds` of time."""

    def rested(self, seconds: float) -> None:
        """`seconds` more than announced by `before` pass at once, because everything sleeps."""

    def bind(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Continue in a changed scene, in which bodies, joints and servos may have other numbers; raises Refused if
        the mechanism cannot.
        """
        raise Refused(f"{self.name} cannot continue in a changed scene")

    def after(self) -> None:
        """Read the simulator after time has passed, and once when the cell is switched on."""

    @abstractmethod
    def state(self) -> S:
        """The state of the mechanism: everything, besides the simulator's state, on which its future depends."""

    def check(self, state: S) -> None:
        """Raise InvalidInput, ValueError, KeyError or TypeError if `state` is impossible for this mechanism."""

    @abstractmethod
    def restore(self, state: S) -> None:
        """Restore a state that has been checked."""

    def release(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Undo optimisations for speed, in this model or in a copy of it."""
