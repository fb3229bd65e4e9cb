"""Measures the true force of all contacts on an arm. This force is for trials and studies, never for the working
phase.
"""

import mujoco
import numpy as np

from handeye.cell.simulated import SimulatedCell
from handeye.core.pose import Array


class ArmContact:
    """The contacts between the arm of a cell and everything else, such as held parts."""

    def __init__(self, cell: SimulatedCell) -> None:
        truth = cell.truth
        self._model, self._data = truth.model, truth.data
        root = self._model.body_rootid
        self._own = root[self._model.geom_bodyid] == root[cell.arm.last_link]

    def force(self) -> Array:
        """Return the sum of the forces of all contacts on the arm now (N, in W), shape (3,). A held part presses on
        the arm with its weight, with its inertia, and with the forces of whatever it touches.
        """
        contact, found, sum_ = self._data.contact, np.zeros(6), np.zeros(3)
        own = self._own[contact.geom]
        for number in np.flatnonzero(own[:, 0] != own[:, 1]):
            mujoco.mj_contactForce(self._model, self._data, int(number), found)
            force = contact.frame[number].reshape(3, 3).T @ found[:3]  # on the second geom
            sum_ += force if own[number, 1] else -force
        return sum_
