"""The torques and positions of the joints in each servo period of a motion: recorded during the motion, and judged
at its end.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from handeye.core.pose import Array


class Exertion(NamedTuple):
    """Torques and positions of the joints in one servo period. Arrays have shape (n,), in N m and rad, or N and m
    for prismatic joints.
    """

    q: Array  # set-points at its beginning
    spare: Array  # torques that weight, inertia and load leave unexplained
    modelled: Array  # torques of weight and motion by the model
    rate: Array  # tachometers at its end


def columns(taken: Sequence[Exertion]) -> Exertion:
    """Collect the values of N servo periods, at least one, into arrays of shape (N, n)."""
    return Exertion(*map(np.array, zip(*taken, strict=True)))
