"""Subset simulation: estimates the probability of a rare failure as a product of probabilities that are not rare.

Source: S.-K. Au and J. L. Beck, Estimation of small failure probabilities in high dimensions by subset simulation,
Probabilistic Engineering Mechanics 16 (2001) 263-277. The Markov chains propose new worlds. The form of the proposals,
and the rule for their step, are from I. Papaioannou, W. Betz, K. Zwirglmaier and D. Straub, MCMC algorithms for subset
simulation, Probabilistic Engineering Mechanics 41 (2015) 89-103; in other fields of science, this form is called
preconditioned Crank-Nicolson.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.record import Record
from handeye.core.variation import LARGEST_SEED
from handeye.trials.rare.points import Point

SHARE: Final = 0.1
"""Probability of a level, given the level before it. The value is that of Au and Beck."""
ACCEPTED: Final = 0.44
"""The step of the proposal is adapted so that about this share of the candidates is accepted. The value is that of
Papaioannou and others.
"""
FIRST_STEP: Final = 0.6  # Papaioannou and others
SMALLEST_STEP: Final = 0.02
REDRAWN: Final = 0.5
"""Probability with which a candidate has new noise. The other candidates keep the noise of the point from which they
were made. If every candidate had new noise, each step would lose the failures that occur only with a rare noise. The
value is our choice.
"""
NORMAL_95: Final = 1.96  # standard deviations
FAILED: Final = 0.0  # a run whose margin is not above this has failed

Margins = Callable[[int, Sequence[Point]], Sequence[float]]
"""Function that executes a run in the world of each point. The function takes the number of a level and the points of
this level, and returns the margin of each run.
"""


class Level(Record, frozen=True, kw_only=True):
    """One level: a sample of worlds in which the margin is at most the threshold of the level before it."""

    number: int
    runs: int  # new runs
    threshold: float
    share: float  # of the sample whose margin is at most the threshold
    failed: int  # number of worlds in the sample in which the program fails
    variation: float  # coefficient of variation of the share
    acceptance: float | None = None  # share of the candidates that were accepted; None: there were none
    step: float | None = None  # of the proposal, at the end of the level: 1 draws worlds independently
    reached: bool = False  # the threshold is the failure itself
    stuck: bool = False  # every world of the sample has the same margin, so that there is no next level


class Estimate(Record, frozen=True, kw_only=True):
    """An estimate of the probability that a margin is at most the threshold of the last level. The estimate is not a
    bound.
    """

    probability: float
    variation: float  # coefficient of variation
    low: float  # an interval that would contain the probability in 95 of 100 repetitions if the logarithm of the
    high: float  # estimate were normally distributed


@dataclass(frozen=True, slots=True)
class _State:
    point: Point
    margin: float


_Chain = list[_State]


def subset_simulation(
    first: Sequence[Point],
    margins: Margins,
    stream: Callable[[int], np.random.Generator],
    most: int,
) -> Iterator[Level]:
    """Yield one level after the other, at most `most` levels. The last level comes earlier if its threshold is the
    failure itself, or if all its worlds have the same margin.

    Args:
        first: worlds drawn independently; each further level has the same number of worlds as `first`.
        stream: function that takes the number of a level and returns the level's random number generator.
    """
    chains = [[_State(*each)] for each in zip(first, margins(0, first), strict=True)]
    level = _level(chains, Level(number=0, runs=len(first), threshold=0, share=0, failed=0, variation=0))
    yield level
    while not (level.reached or level.stuck) and level.number + 1 < most:
        states = (state for chain in chains for state in chain)
        seeds = [state for state in states if state.margin <= level.threshold]
        walk = _Walk(seeds, level, margins, stream(level.number + 1))
        chains = walk.chains(len(first))
        level = _level(chains, walk.told)
        yield level


def estimate(levels: Sequence[Level]) -> Estimate:
    """Return the product of the shares of all levels, with its variation. Like Au and Beck, this function computes the
    variation as if the levels were independent.
    """
    probability = math.prod(level.share for level in levels)
    variation = math.sqrt(sum(level.variation**2 for level in levels))
    away = math.exp(NORMAL_95 * math.sqrt(math.log1p(variation**2)))
    return Estimate(
        probability=probability,
        variation=variation,
        low=probability / away,
        high=min(1.0, probability * away),
    )


class _Walk:
    """Markov chains over the worlds whose margins are below a threshold. The chains do not change the distribution of
    these worlds.
    """

    def __init__(
        self, seeds: Sequence[_State], last: Level, margins: Margins, rng: np.random.Generator
    ) -> None:
        self._seeds, self._last, self._margins, self._rng = seeds, last, margins, rng
        self._step = last.step or FIRST_STEP
        self._runs = self._accepted = 0

    def chains(self, length: int) -> list[_Chain]:
        """Return the chains of the next level. Together, these chains have `length` states. In each round, every
        chain that is not yet complete advances by one state.
        """
        least, more = divmod(length, len(self._seeds))
        lengths = [least + (number < more) for number in range(len(self._seeds))]
        chains = [[seed] for seed in self._seeds]
        for done in range(1, max(lengths)):
            self._advance(
                [chain for chain, all_of_it in zip(chains, lengths, strict=True) if done < all_of_it], done
            )
        return chains

    @property
    def told(self) -> Level:
        """The level with the values that are known before its sample is complete. The other values are 0."""
        return Level(
            number=self._last.number + 1, runs=self._runs, threshold=0, share=0, failed=0, variation=0,
            acceptance=self._accepted / self._runs, step=self._step,
        )  # fmt: skip

    def _advance(self, chains: Sequence[_Chain], done: int) -> None:
        candidates = [self._candidate(chain[-1].point) for chain in chains]
        found = self._margins(self._last.number + 1, candidates)
        accepted = [margin <= self._last.threshold for margin in found]
        for chain, point, margin, taken in zip(chains, candidates, found, accepted, strict=True):
            chain.append(_State(point, margin) if taken else chain[-1])
        self._runs += len(chains)
        self._accepted += sum(accepted)
        step = self._step * math.exp((sum(accepted) / len(chains) - ACCEPTED) / math.sqrt(done))
        self._step = min(1.0, max(SMALLEST_STEP, step))

    def _candidate(self, point: Point) -> Point:
        """Propose a world near the world `point`. If every proposal were accepted, the random numbers that describe
        each world would stay independent and standard normal.
        """
        drawn, kept = self._rng.standard_normal(len(point.numbers)), math.sqrt(1 - self._step**2)
        redrawn, noise = self._rng.random() < REDRAWN, int(self._rng.integers(LARGEST_SEED, endpoint=True))
        return Point(kept * point.numbers + self._step * drawn, noise if redrawn else point.noise)


def _level(chains: Sequence[_Chain], told: Level) -> Level:
    """Complete a level: compute its threshold, its share and its number of failures from the sample of the level."""
    margins = sorted(state.margin for chain in chains for state in chain)
    threshold, failed = _threshold(margins), sum(margin <= FAILED for margin in margins)
    below = sum(margin <= threshold for margin in margins)
    return Level(
        number=told.number, runs=told.runs, acceptance=told.acceptance, step=told.step,
        threshold=threshold, share=below / len(margins), failed=failed,
        variation=_variation([[state.margin <= threshold for state in chain] for chain in chains]),
        reached=threshold <= FAILED, stuck=below == len(margins) and threshold > FAILED,
    )  # fmt: skip


def _threshold(margins: Sequence[float]) -> float:
    """Return the first decile of a sorted sample of margins. If most of the sample has this same margin, return the
    next smaller margin.
    """
    found = margins[math.ceil(SHARE * len(margins)) - 1]
    if found > FAILED and sum(margin <= found for margin in margins) > len(margins) / 2:
        found = max((margin for margin in margins if margin < found), default=found)
    return max(found, FAILED)


def _variation(below: Sequence[Sequence[bool]]) -> float:
    """Return the coefficient of variation of the share of states below a threshold: equations 25 to 29 of Au and
    Beck, for chains of any length.
    """
    runs, share = sum(map(len, below)), sum(map(sum, below)) / sum(map(len, below))
    if share in (0.0, 1.0):
        return 0.0
    correlation = 0.0
    for lag in range(1, max(map(len, below))):
        pairs = [(a, b) for chain in below for a, b in zip(chain, chain[lag:], strict=False)]
        both = sum(a and b for a, b in pairs) / len(pairs)
        correlation += 2 * len(pairs) / runs * (both - share**2) / (share * (1 - share))
    return math.sqrt((1 - share) / (share * runs) * (1 + max(0.0, correlation)))
