"""What the learned policy and its teacher see: features of the readings, and of the policy's own actions."""

from typing import Final

import numpy as np

from handeye.arm.kinematics import forward
from handeye.core.pose import Array
from handeye.env.policies import Facts
from handeye.env.spaces import STEP, Observation

FEATURES: Final = (
    "radius", "height", "height over the face", "touched", "lag, radial", "lag, tangential", "lag, vertical",
    "lag, vertical, averaged", "rise in .35 s", "rise in 1.5 s",
)  # fmt: skip
_UNITS: Final = np.array(
    [5e-3, 1e-2, 1e-2, 1.0, 2e-3, 2e-3, 2e-3, 2e-3, 1e-3, 1e-3]
)  # m, except for `touched`
_PERIOD: Final = 1 / 60  # s
_FAST, _SLOW, _LONG = 0.07, 0.35, 1.5  # time constants of the averages, s
_CONTACT: Final = -0.0015  # vertical lag at which the pin has touched the face, m: about 8 N
_SPEED: Final = 0.01  # of the set-point at an answer of 1, m/s


class Senses:
    """Remembers what a network without a memory cannot: averages, the height of the first contact, its set-point.

    Places are relative to the place of the hand at the start. The lag is the set-point minus the measured place; it
    grows with the force. Lateral components are radial and tangential: the search has no preferred direction.
    """

    def __init__(self, facts: Facts) -> None:
        self._facts, self._start = facts, np.full(3, np.nan)
        self._place, self._lag, self._averaged = np.zeros(3), np.zeros(3), 0.0
        self._heights = np.zeros(3)  # of the hand: averages over _FAST, _SLOW and _LONG
        self._face = np.nan  # height of the first contact

    def see(self, observation: Observation) -> Array:
        """Return the features after a reading, shape (10,), each in a unit in which it is about 1."""
        hand = forward(self._facts.arm, observation["q"])[:3, 3]
        if np.isnan(self._start[0]):
            self._start = hand
        here = hand - self._start
        self._lag += (self._place - here - self._lag) * (_PERIOD / _FAST)
        self._averaged += (self._lag[2] - self._averaged) * (_PERIOD / _SLOW)
        self._heights += (here[2] - self._heights) * (_PERIOD / np.array([_FAST, _SLOW, _LONG]))
        if self._lag[2] < _CONTACT and np.isnan(self._face):
            self._face = self._heights[0]
        height, slow, long = self._heights
        touched = not np.isnan(self._face)
        return np.array([
            np.hypot(*self._place[:2]), height, height - self._face if touched else 0.0, touched,
            *(self._axes() @ self._lag[:2]), self._lag[2], self._averaged, height - slow, height - long,
        ]) / _UNITS  # fmt: skip

    def action(self, answer: Array) -> Array:
        """Return the action for an answer, shape (4,): radial, tangential and vertical speed, and `done`."""
        speed = np.array([*(answer[:2] @ self._axes()), answer[2]])
        moved = np.clip(speed * _SPEED * _PERIOD, -STEP, STEP)
        self._place = self._place + moved
        values = {"grip": 1.0, "done": float(answer[3] > 0.5)}
        values |= dict(zip(("move.x", "move.y", "move.z"), moved / STEP, strict=True))
        return np.array([values.get(part.name, 0.0) for part in self._facts.components])

    def _axes(self) -> Array:
        """Return the radial and the tangential direction at the set-point, shape (2, 2)."""
        radius = float(np.hypot(*self._place[:2]))
        x, y = self._place[:2] / radius if radius > 1e-6 else (1.0, 0.0)
        return np.array([[x, y], [-y, x]])
