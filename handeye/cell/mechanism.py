"""The parts of a simulated cell that act as time passes: devices, and whatever else a task adds to the physics."""

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
    """While the context is open, convert each KeyError to a BadArgument whose sentence says which name the scene
    lacks.
    """
    try:
        yield
    except KeyError as error:
        raise BadArgument(f"{what} cannot work in this scene: {error.args[0]}") from None


class Mechanism(ABC, Generic[S]):
    """A part of a cell that acts on the simulator before each advance of the simulated time, and may read the
    simulator afterwards.
    """

    name: str  # by which its state is found
    kind: type[S]  # the type of its state
    changes: ClassVar[tuple[str, ...]] = ()
    """Fields of the MuJoCo model that the mechanism changes as it runs. These fields are part of the state of the
    cell.
    """

    def begin_stage(self, number: int) -> None:
        """Apply the effects that are due at stage `number` of the program or at an earlier stage. The first stage has
        the number 1.
        """

    def before(self, seconds: float) -> None:
        """Prepare for the next `seconds`."""

    def rested(self, seconds: float) -> None:
        """Let `seconds` pass without physics steps, because everything sleeps. These seconds are in addition to those
        for which the method `before` is called.
        """

    def bind(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Continue in a changed scene, in which bodies, joints and servos may have other numbers. Raises Refused if
        the mechanism cannot continue in that scene.
        """
        raise Refused(f"{self.name} cannot continue in a changed scene")

    def after(self) -> None:
        """Read the simulator after time has passed, and once when the cell is switched on."""

    @abstractmethod
    def state(self) -> S:
        """Return the state of the mechanism: all values on which its future depends, except the state of the
        simulator.
        """

    def check(self, state: S) -> None:
        """Raise InvalidInput, ValueError, KeyError or TypeError if `state` is impossible for this mechanism."""

    @abstractmethod
    def restore(self, state: S) -> None:
        """Restore a state that has been checked."""

    def release(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Undo, in this model or in a copy of it, the changes that only make the simulation faster."""
