"""A part of a simulated cell that acts as time passes: any device, or anything that a task adds to the physics."""

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
    """Raise BadArgument, with a sentence, where a scene lacks a name that something in it needs."""
    try:
        yield
    except KeyError as error:
        raise BadArgument(f"{what} cannot work in this scene: {error.args[0]}") from None


class Mechanism(ABC, Generic[S]):
    """Acts on the simulator before time passes, and may read it afterwards."""

    name: str  # by which its state is found
    kind: type[S]  # the type of its state
    changes: ClassVar[tuple[str, ...]] = ()
    """Fields of the MuJoCo model that it changes as it runs: they belong to the state of the cell."""

    def begin_stage(self, number: int) -> None:
        """Apply the effects due at a stage of the program, by its number from 1, or at an earlier one."""

    def before(self, seconds: float) -> None:
        """Prepare for a step of time (s)."""

    def rested(self, seconds: float) -> None:
        """More time (s) than that of `before` passes at once, because everything sleeps."""

    def bind(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Continue in a changed scene, where numbers of bodies, joints and servos may be others, if it can."""
        raise Refused(f"{self.name} cannot continue in a changed scene")

    def after(self) -> None:
        """Read the simulator when time has passed, and once when the cell is switched on."""

    @abstractmethod
    def state(self) -> S:
        """Everything its future depends on, besides the simulator."""

    def check(self, state: S) -> None:
        """Raise InvalidInput, ValueError, KeyError or TypeError if a state cannot be one of this mechanism."""

    @abstractmethod
    def restore(self, state: S) -> None:
        """Put it into a state that has been checked."""

    def release(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Give up optimisations for speed, in this model or a copy of it."""
