"""How sure a count of successes makes us of the rate behind it."""

from collections.abc import Sequence
from typing import Final

from handeye.core.record import Record

CONFIDENCE: Final = 0.95


class Rate(Record, frozen=True, kw_only=True):
    """Successes among independent trials, with what they say about the probability of success."""

    successes: int
    trials: int
    rate: float | None  # Successes over trials; None, as the bounds: nothing was tried
    wilson95: tuple[float, float] | None
    """Wilson's score interval: it holds the probability in about 95 of 100 batches."""
    p_s: float | None
    """Lower bound of the probability, 95 % one-sided: the least p for which this many successes have a chance
    of 5 %. It is the exact bound of Clopper and Pearson."""


def rate(successes: int, trials: int) -> Rate:
    """Success rate with its bounds."""
    from scipy.stats import binomtest  # slow to import

    if trials == 0:
        return Rate(successes=0, trials=0, rate=None, wilson95=None, p_s=None)
    both = binomtest(successes, trials).proportion_ci(CONFIDENCE, method="wilson")
    above = binomtest(successes, trials, alternative="greater").proportion_ci(CONFIDENCE, method="exact")
    return Rate(
        successes=successes,
        trials=trials,
        rate=successes / trials,
        wilson95=(float(both.low), float(both.high)),
        p_s=float(above.low),
    )


def mcnemar(only_first: int, only_second: int) -> float:
    """Two-sided p of McNemar's exact test: how likely pairs that differ fall so unevenly if neither is better."""
    from scipy.stats import binomtest

    differ = only_first + only_second
    return 1.0 if differ == 0 else float(binomtest(only_first, differ).pvalue)


def signed_rank(differences: Sequence[float]) -> float:
    """Two-sided p of Wilcoxon's signed-rank test: how likely pairs differ so far to one side if both are alike."""
    from scipy.stats import wilcoxon

    return float(wilcoxon(differences).pvalue) if any(differences) else 1.0
