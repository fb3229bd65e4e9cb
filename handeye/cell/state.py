"""The complete state of a simulated cell, as plain figures: for checkpoints and for going back in time."""

import json
import math
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np

from handeye.core.errors import BadFile
from handeye.core.pose import Array
from handeye.core.record import Record

V = TypeVar("V", bound=Array | Sequence[float])


class CellState(Record, frozen=True, kw_only=True):
    """The complete state of a cell, besides its world and its inputs."""

    physics: Array  # MuJoCo's integration state; it begins with the time
    figures: dict[str, Array]  # the fields of the model that the mechanisms of the cell change, as numbers
    noise: str  # state of the sensors' generator, as JSON
    mechanisms: dict[str, dict[str, Any]]
    """The state of each device and mechanism by its name; each checks its own before it is used."""

    @property
    def time(self) -> float:
        """s on the cell's clock."""
        return float(self.physics[0])


def noise_state(rng: np.random.Generator) -> str:
    """The state of a generator."""
    return json.dumps(rng.bit_generator.state)


def set_noise(rng: np.random.Generator, state: str) -> None:
    """Put a generator into a state; raises what `json.loads` and numpy raise if it is not one."""
    rng.bit_generator.state = json.loads(state)


def check_noise(state: str) -> None:
    """See that a generator can be put into a state; raises as `set_noise` if it cannot."""
    set_noise(np.random.Generator(np.random.PCG64(0)), state)


def figures(values: Array) -> tuple[float, ...]:
    """An array of one dimension as plain numbers."""
    return tuple(values.tolist())


def finite(values: V, what: str) -> V:
    """The same values; `what` names them; raises InvalidInput if one of them is not a finite number."""
    if not all(map(math.isfinite, values)):
        raise BadFile(f"{what} holds a value that is not a finite number")
    return values
