"""The complete state of a simulated cell, as plain values, for checkpoints and for going back in time."""

import json
import math
from collections.abc import Sequence
from typing import Any, Final, TypeVar

import numpy as np

from handeye.core.errors import BadFile
from handeye.core.pose import Array
from handeye.core.record import Record

V = TypeVar("V", bound=Array | Sequence[float])


class CellState(Record, frozen=True, kw_only=True):
    """The complete state of a cell, without the world and the inputs of the cell."""

    physics: Array  # MuJoCo's integration state; it begins with the time
    figures: dict[str, Array]  # the fields of the model that the mechanisms of the cell change, as numbers
    noise: str  # state of the sensors' generator, as JSON
    mechanisms: dict[str, dict[str, Any]]
    """The state of each device and mechanism, by name. Each mechanism checks its state before use."""

    @property
    def time(self) -> float:
        """Seconds on the cell's clock."""
        return float(self.physics[0])

    def equals(self, other: "CellState") -> bool:
        """Return True if `other` is the same state of the same cell."""
        return (
            np.array_equal(self.physics, other.physics)
            and self.noise == other.noise
            and self.mechanisms == other.mechanisms
            and all(np.array_equal(values, other.figures[name]) for name, values in self.figures.items())
        )


_SCRATCH: Final = np.random.Generator(np.random.PCG64(0))  # states are tried on it


def noise_state(rng: np.random.Generator) -> str:
    """Return the state of a random number generator as text."""
    return json.dumps(rng.bit_generator.state)


def set_noise(rng: np.random.Generator, state: str) -> None:
    """Set the state of a random number generator. Raises the exceptions of `json.loads` and NumPy if the state is
    invalid.
    """
    rng.bit_generator.state = json.loads(state)


def check_noise(state: str) -> None:
    """Check the state of a random number generator. Raises the same exceptions as `set_noise`."""
    set_noise(_SCRATCH, state)


def figures(values: Array) -> tuple[float, ...]:
    """Convert a one-dimensional array to plain numbers."""
    return tuple(values.tolist())


def finite(values: V, what: str) -> V:
    """Return the values. Raises InvalidInput if a value is not finite; `what` names the values in the message."""
    if not all(map(math.isfinite, values.tolist() if isinstance(values, np.ndarray) else values)):
        raise BadFile(f"{what} holds a value that is not a finite number")
    return values
