"""Random number streams by seed and name."""

from __future__ import annotations

from zlib import crc32

import numpy as np


def random_numbers(seed: int, name: str) -> np.random.Generator:
    """The stream of a name in the world of a seed."""
    return np.random.default_rng(np.random.SeedSequence([seed, crc32(name.encode())]))
