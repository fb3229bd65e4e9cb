"""Each seed and each name have a stream of random numbers of their own."""

import numpy as np

from handeye.core.distributions import random_numbers

SEEDS = (0, 1, 2, 3, 1000, 70_123, 2**31, 2**32 - 1, 2**63 - 1)


def test_seeds_and_names_have_streams_of_their_own() -> None:
    drawn = np.array([[random_numbers(seed, name).random() for seed in SEEDS] for name in ("a", "b")])
    assert len(set(drawn.ravel())) == drawn.size
