"""Streams of many seeds at once are those of each seed by itself."""

import numpy as np
import pytest

from handeye.core.random_streams import random_numbers, streams

SEEDS = (0, 1, 2, 3, 1000, 70_123, 2**31, 2**32 - 1)


@pytest.mark.parametrize("name", ["arm.offset.1", "camera.place.x", ""])
def test_many_streams_are_the_same_as_one_by_one(name: str) -> None:
    for seed, stream in zip(SEEDS, streams(SEEDS, name), strict=True):
        assert (stream.standard_normal(50) == random_numbers(seed, name).standard_normal(50)).all()


def test_few_seeds_and_seeds_beyond_a_word_have_theirs_too() -> None:
    for seeds in ((5,), (*SEEDS, 2**40, 2**63 - 1)):
        drawn = [stream.uniform() for stream in streams(seeds, "thread_phase.1")]
        assert drawn == [random_numbers(seed, "thread_phase.1").uniform() for seed in seeds]


def test_seeds_and_names_have_streams_of_their_own() -> None:
    drawn = np.array([[stream.random() for stream in streams(SEEDS, name)] for name in ("a", "b")])
    assert len(set(drawn.ravel())) == drawn.size
