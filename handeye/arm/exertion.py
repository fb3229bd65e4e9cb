"""What a motion takes of the joints, servo period by servo period: taken down as it happens, judged at its end."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from handeye.core.pose import Array


class Exertion(NamedTuple):
    """What the joints took in a servo period; arrays of shape (n,), N m and rad (N and m if prismatic)."""

    q: Array  # set-points at its beginning
    spare: Array  # torques that weight, inertia and load leave unexplained
    modelled: Array  # torques of weight and motion by the model
    rate: Array  # tachometers at its end


def columns(taken: Sequence[Exertion]) -> Exertion:
    """The figures of N servo periods, one at least, each as an array of shape (N, n)."""
    return Exertion(*map(np.array, zip(*taken, strict=True)))
