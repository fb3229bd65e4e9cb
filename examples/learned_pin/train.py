"""Trains the learned policy, by imitation of the teacher in worlds of its own (DAgger, Ross and others 2011).

$ pip install 'handeye[env]' scikit-learn
$ python -m examples.learned_pin.train

In the first round, the teacher acts, and its actions are disturbed at random. In each later round, the network acts
in worlds that are new to it. In every servo period, the teacher answers what the actor sees; the network is trained
on all answers so far. So its score in a round is a score in unseen worlds.
"""

import csv
import multiprocessing
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from sklearn.neural_network import MLPRegressor
from threadpoolctl import threadpool_limits

from examples.learned_pin.policy import Network
from examples.learned_pin.senses import Senses
from examples.learned_pin.teacher import answer
from handeye.core.pose import Array
from handeye.env.environment import AssemblyEnv
from handeye.env.evaluation import play
from handeye.env.policies import Facts, Policy
from handeye.env.spaces import Observation

FIRST: Final = 5000  # seed of the first world
WORLDS: Final = (2, 20, 20, 20, 20, 20)  # in each round
EPOCHS: Final = 30  # after each round
LIMIT: Final = 25.0  # time limit of an episode in training, s
DISTURBED: Final = 0.4  # standard deviation of a disturbance, in units of 10 mm/s
HELD: Final = 15  # periods for which it lasts
LINGERED: Final = 30  # periods for which the teacher presses on when it could say done
CURVE: Final = Path(__file__).with_name("curve.csv")


class Played(NamedTuple):
    """An episode of training."""

    seen: Array  # features, shape (periods, 10)
    answers: Array  # of the teacher, shape (periods, 4)
    outcome: str
    cpu: float  # s


class Recorder(Policy):
    """Lets the network act, or the teacher with disturbances, and notes what the teacher answers."""

    def __init__(self, facts: Facts, network: Network | None) -> None:
        super().__init__(facts)
        self._senses, self._network = Senses(facts), network
        self._random, self._disturbed = np.random.default_rng(facts.seed), np.zeros(4)
        self.seen: list[Array] = []
        self.answers: list[Array] = []

    def act(self, observation: Observation) -> Array:
        seen = self._senses.see(observation)
        self.seen.append(seen)
        self.answers.append(answer(seen))
        return self._senses.action(self._shown() if self._network is None else self._network(seen))

    def _shown(self) -> Array:
        """Return the teacher's last answer, disturbed half of the time. It says done only when it has lingered."""
        if len(self.seen) % HELD == 1:
            self._disturbed[:3] = self._random.normal(0, DISTURBED, 3) * self._random.integers(2)
        done = np.array(self.answers[-LINGERED:])[:, 3].sum() == LINGERED
        return np.array([*(self.answers[-1] + self._disturbed)[:3], float(done)])


def played(job: tuple[int, Network | None]) -> Played:
    """Play the episode of a seed."""
    seed, network = job
    began, made = time.process_time(), []

    def maker(facts: Facts) -> Recorder:
        made.append(Recorder(facts, network))
        return made[0]

    found = play(AssemblyEnv("handeye/Pin-v0", limit_s=LIMIT), maker, seed)
    return Played(
        np.array(made[0].seen),
        np.array(made[0].answers),
        found.referee["outcome"],
        time.process_time() - began,
    )


def fitted(model: MLPRegressor, rounds: list[Played]) -> Network:
    """Train further on the answers of all episodes."""
    seen = np.concatenate([each.seen[::2] for each in rounds])
    answers = np.concatenate([each.answers[::2] for each in rounds])
    for _ in range(EPOCHS):
        model.partial_fit(seen, answers)
    return Network(list(zip(model.coefs_, model.intercepts_, strict=True)))


def main(played_in: Callable[..., Any]) -> None:
    """Train in rounds, and write the weights and the curve."""
    model = MLPRegressor(hidden_layer_sizes=(64, 64), activation="tanh", batch_size=128, random_state=0)
    network, all_played, rows, cpu = None, [], [], 0.0
    for number, worlds in enumerate(WORLDS):
        seeds = range(FIRST + len(all_played), FIRST + len(all_played) + worlds)
        new = played_in(played, [(seed, network) for seed in seeds], chunksize=1)
        ends = [each.outcome for each in new]
        periods = sum(len(each.seen) for each in all_played)
        rows.append([number, worlds, ends.count("right"), ends.count("false done"), periods, round(cpu)])
        print(*rows[-1], flush=True)
        cpu += sum(each.cpu for each in new)
        all_played += new
        began = time.process_time()
        if number < len(WORLDS) - 1:  # the last round only measures
            fitted(model, all_played).save()
            network = Network.load()
        cpu += time.process_time() - began
    print(f"{cpu:.0f} s of processor time")
    with CURVE.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["round", "worlds", "right", "false_done", "periods", "cpu_s"])
        table.writerows(rows)


if __name__ == "__main__":
    with threadpool_limits(1), multiprocessing.get_context("spawn").Pool(2) as pool:
        main(pool.map)
