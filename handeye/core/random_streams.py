"""Streams of random numbers by seed and name; those of many seeds at once cost a tenth of the same one by one."""

from collections.abc import Iterator, Sequence
from typing import Any, Final, cast
from zlib import crc32

import numpy as np
from numpy.random.bit_generator import ISeedSequence
from numpy.typing import NDArray

_Words = NDArray[np.uint32]
_WORD: Final = 1 << 32
_FEW: Final = 8
"""Streams that are begun faster one by one."""
_POOL: Final = 4
_FIRST: Final = (0x43B0D7E5, 0x931E8875)
_SECOND: Final = (0x8B51F9DD, 0x58F38DED)
_LEFT, _RIGHT = np.uint32(0xCA01F9DD), np.uint32(0x4973F715)
_SHIFT: Final = np.uint32(16)
"""Figures of `numpy.random.SeedSequence`, whose streams numpy keeps as they are (NEP 19)."""


def random_numbers(seed: int, name: str) -> np.random.Generator:
    """The stream of random numbers of a name in the world of a seed."""
    return np.random.default_rng(np.random.SeedSequence([seed, crc32(name.encode())]))


def streams(seeds: Sequence[int], name: str) -> Iterator[np.random.Generator]:
    """The streams of a name in the worlds of several seeds: each is that of `random_numbers`."""
    if len(seeds) < _FEW or any(seed >= _WORD for seed in seeds):
        yield from (random_numbers(seed, name) for seed in seeds)
        return
    for words in _states(np.array(seeds, dtype=np.uint32), name):
        mixed = cast(
            "np.random.SeedSequence", _Mixed(words)
        )  # numpy takes any ISeedSequence, and types the one
        yield np.random.Generator(np.random.PCG64(mixed))


class _Mixed(ISeedSequence):
    """A seed sequence that is mixed already."""

    def __init__(self, words: NDArray[np.uint64]) -> None:
        self._words = words

    def generate_state(self, n_words: int, dtype: Any = np.uint32) -> Any:
        assert (n_words, dtype) == (len(self._words), np.uint64), "PCG64 asks for just these"
        return self._words


def _states(seeds: _Words, name: str) -> NDArray[np.uint64]:
    """What a SeedSequence of seed and name generates for each of many seeds, shape (n, 4)."""
    none = np.zeros_like(seeds)
    hashing = _Hash(*_FIRST)
    pool = [hashing(word) for word in (seeds, np.full_like(seeds, crc32(name.encode())), none, none)]
    for source in range(_POOL):
        for to in range(_POOL):
            if source != to:
                mixed = _LEFT * pool[to] - _RIGHT * hashing(pool[source])
                pool[to] = mixed ^ (mixed >> _SHIFT)
    hashing = _Hash(*_SECOND)
    words = [hashing(pool[k % _POOL]) for k in range(2 * _POOL)]
    return np.ascontiguousarray(np.stack(words, axis=-1)).view("<u8")


class _Hash:
    """A hash of words whose constant changes from one to the next."""

    def __init__(self, constant: int, factor: int) -> None:
        self._constant, self._factor = constant, factor

    def __call__(self, words: _Words) -> _Words:
        words = words ^ np.uint32(self._constant)
        self._constant = self._constant * self._factor % _WORD
        words = words * np.uint32(self._constant)
        return words ^ (words >> _SHIFT)
