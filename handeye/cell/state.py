"""The complete state of a simulated cell, as plain figures: for checkpoints and for going back in time."""

import json
from typing import Annotated, Final

import msgspec
import numpy as np

from handeye.ports.workcell import Sensed
from handeye.pose import Array
from handeye.tasks.water_pump.threads import Thread

MUTABLE: Final = (
    "dof_frictionloss",
    "actuator_gainprm",
    "actuator_biasprm",
    "actuator_forcerange",
    "eq_data",
    "geom_contype",
    "geom_conaffinity",
    "geom_group",
    "mat_rgba",
    "mat_emission",
)
"""Fields of the model that the events of a cell change: brakes, threads, clamping, the fingers' force, the lamp."""

Pair = tuple[float, float]
Hole = Annotated[int, msgspec.Meta(ge=0, le=6)]


class CameraState(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The camera's mechanism and tube."""

    noise: str
    """State of its generator, as JSON."""
    lens: float
    pots: Pair
    stand: Pair
    focus: float | None
    """None: at infinity."""
    gain: float | None


class CellState(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All that a cell's future depends on, besides its world and what is put out to it."""

    physics: Array
    """MuJoCo's integration state."""
    figures: dict[str, Array]
    """The fields of the model named in MUTABLE, as numbers."""
    threads: tuple[Thread, ...]
    driven: Hole
    """The hole whose carrier the driver's motor is coupled to."""
    clamped: bool
    fingers: float
    """Set-point of the finger servo, m."""
    tripped: bool
    sensed: Sensed
    noise: str
    """State of the sensors' generator, as JSON."""
    camera: CameraState


def noise_state(rng: np.random.Generator) -> str:
    """The state of a generator."""
    return json.dumps(rng.bit_generator.state)


def set_noise(rng: np.random.Generator, state: str) -> None:
    """Put a generator into a state.

    Raises:
        ValueError, KeyError, TypeError: it is not one.
    """
    rng.bit_generator.state = json.loads(state)
