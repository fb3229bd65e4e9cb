"""The complete state of a simulated cell, as plain figures, for checkpoints and for going back in time."""

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
    """The complete state of a cell, without its world and its inputs."""

    physics: Array  # MuJoCo's integration state; it begins with the time
    figures: dict[str, Array]  # the fields of the model that the mechanisms of the cell change, as numbers
    noise: str  # state of the sensors' generator, as JSON
    mechanisms: dict[str, dict[str, Any]]
    """The state of each device and mechanism, by name; each mechanism checks its state before use."""

    @property
    def time(self) -> float:
        """Seconds on the cell's clock."""
        return float(self.physics[0])


_SCRATCH: Final = np.random.Generator(np.random.PCG64(0))  # states are tried on it


def noise_state(rng: np.random.Generator) -> str:
    """The state of a random number generator."""
    return json.dumps(rng.bit_generator.state)


def set_noise(rng: np.random.Generator, state: str) -> None:
    """Set the state of a random number generator; raises what `json.loads` and NumPy raise if the state is invalid."""
    rng.bit_generator.state = json.loads(state)


def check_noise(state: str) -> None:
    """Check the state of a random number generator; raises the same errors as `set_noise`."""
    set_noise(_SCRATCH, state)


def figures(values: Array) -> tuple[float, ...]:
    """A one-dimensional array as plain numbers."""
    return tuple(values.tolist())


def finite(values: V, what: str) -> V:
    """Return the values; raises InvalidInput if one of them is not finite, with `what` as the name of the values."""
    if not all(map(math.isfinite, values)):
        raise BadFile(f"{what} holds a value that is not a finite number")
    return values
