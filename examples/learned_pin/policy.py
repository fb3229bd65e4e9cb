"""A learned policy for `handeye/Pin-v0`: a network with two hidden layers. docs/environments.md says how it does.

$ handeye env evaluate examples.learned_pin.policy:LearnedPin --env handeye/Pin-v0 --n 20 --seed 1000
"""

from pathlib import Path
from typing import Final

import numpy as np

from examples.learned_pin.senses import Senses
from handeye.core.pose import Array
from handeye.env.policies import Facts, Policy
from handeye.env.spaces import ActionKind, Observation

WEIGHTS: Final = Path(__file__).with_name("weights.npz")


class Network:
    """The network: tanh in the hidden layers, and nothing after the last one."""

    def __init__(self, layers: list[tuple[Array, Array]]) -> None:
        self.layers = layers  # weights, shape (inputs, outputs), and biases, shape (outputs,)

    @classmethod
    def load(cls, path: Path = WEIGHTS) -> "Network":
        """Read the weights from a file of numpy's, without pickle."""
        with np.load(path, allow_pickle=False) as kept:
            return cls([(kept[f"weights.{k}"], kept[f"biases.{k}"]) for k in range(len(kept.files) // 2)])

    def save(self, path: Path = WEIGHTS) -> None:
        """Write the weights, in single precision."""
        named = {"weights": 0, "biases": 1}
        np.savez(path, **{f"{name}.{k}": layer[i].astype(np.float32)
                          for k, layer in enumerate(self.layers) for name, i in named.items()})  # fmt: skip

    def __call__(self, features: Array) -> Array:
        """Return radial, tangential and vertical speed, and `done`, for features of shape (10,)."""
        answer = features
        for weights, biases in self.layers[:-1]:
            answer = np.tanh(answer @ weights + biases)
        weights, biases = self.layers[-1]
        return answer @ weights + biases


class LearnedPin(Policy):
    """Acts, and says done, as the network answers the readings."""

    actions: tuple[ActionKind, ...] = ("hand",)
    environments = ("handeye/Pin-v0",)

    def __init__(self, facts: Facts) -> None:
        super().__init__(facts)
        self._senses, self._network = Senses(facts), Network.load()

    def act(self, observation: Observation) -> Array:
        return self._senses.action(self._network(self._senses.see(observation)))


class PressingPin(Policy):
    """For comparison: presses straight down without a search, and says done when the hand lags by 4 mm."""

    actions: tuple[ActionKind, ...] = ("hand",)
    environments = ("handeye/Pin-v0",)

    def __init__(self, facts: Facts) -> None:
        super().__init__(facts)
        self._senses = Senses(facts)

    def act(self, observation: Observation) -> Array:
        pressed = 2 * self._senses.see(observation)[7] < -4.0
        return self._senses.action(np.array([0.0, 0.0, -0.3, float(pressed)]))
