"""Computes the statistics of a sweep from its rows: success rates with confidence bounds, measured values, and
failures by stage and cause.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from handeye.core.record import Record
from handeye.trials.sweep import R, Sweep

CONFIDENCE: Final = 0.95


class Rate(Record, frozen=True, kw_only=True):
    """The number of successes among independent trials, with confidence bounds on the probability of success."""

    successes: int
    trials: int
    rate: float | None  # Successes over trials; None, like the bounds, if nothing was tried
    wilson95: tuple[float, float] | None
    """Wilson's score interval. In about 95 of 100 batches, the interval contains the true probability."""
    p_s: float | None
    """Lower bound of the one-sided 95 % confidence interval of the probability (Clopper and Pearson). If the true
    probability were equal to this bound, 5 % of such batches would have at least as many successes as this batch.
    """


def rate(successes: int, trials: int) -> Rate:
    """Compute a success rate and its confidence bounds."""
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
    """Return the two-sided p-value of McNemar's exact test. The test counts the pairs in which only the first trial
    succeeded, and the pairs in which only the second trial succeeded. The p-value is the probability, for equally good
    batches, that the two counts differ at least as much as the given counts.
    """
    from scipy.stats import binomtest

    differ = only_first + only_second
    return 1.0 if differ == 0 else float(binomtest(only_first, differ).pvalue)


def signed_rank(differences: Sequence[float]) -> float:
    """Return the two-sided p-value of Wilcoxon's signed-rank test. The p-value is the probability, for equally good
    batches, that the differences favour one of the batches at least as strongly as the given differences.
    """
    from scipy.stats import wilcoxon

    return float(wilcoxon(differences).pvalue) if any(differences) else 1.0


class Spread(Record, frozen=True, kw_only=True):
    """The distribution of a measured value."""

    n: int
    median: float
    p95: float  # 95 % of the values are at most this
    most: float


class ConditionFigures(Record, frozen=True, kw_only=True):
    """Statistics of the trials that share a condition."""

    condition: str
    n: int  # Trials that count
    right: int
    outcomes: dict[str, int]
    wilson95: tuple[float, float] | None
    p_s: float | None
    measures: dict[str, Spread]


class Failure(Record, frozen=True, kw_only=True):
    """A failed trial."""

    trial: int
    seed: int
    condition: str
    verdict: str
    stage: str
    cause: str  # Equal causes have equal words
    detail: str  # Cause with the measured values
    line: str | None  # Line of the script where the program stopped
    command: str  # Command that repeats the trial


class Cause(Record, frozen=True, kw_only=True):
    """The failures that happened in the same stage for the same cause."""

    stage: str
    cause: str
    count: int
    command: str  # Command that repeats the first of these trials


class Figures(Record, frozen=True, kw_only=True):
    """Statistics of a sweep. Equal sweeps have equal statistics, except for computing time."""

    kind: str
    n: int  # Trials that count
    right: int
    silent_failures: int  # Failures that the program reported as a success
    failed: int
    """Trials that did not finish: an exception or a limit ended them, or their process was killed twice."""
    uncounted: int
    killed: int  # How often the process of a trial was killed
    wilson95: tuple[float, float] | None  # Wilson's interval of the probability that a trial is right
    p_s: float | None  # Lower bound of this probability, 95 % one-sided, exact
    outcomes: dict[str, int]
    measures: dict[str, Spread]
    conditions: tuple[ConditionFigures, ...]  # If there are several conditions
    failures: tuple[Failure, ...]
    causes: tuple[Cause, ...]  # Causes of the failures, the most frequent first
    cpu_s: float  # CPU time of all trials
    wall_s: float  # Time since this command began

    @property
    def exit_code(self) -> int:
        """Exit code of the command: 3 if the program reported a failure as a success in any trial, 1 if every trial
        failed, and 0 in all other cases.
        """
        return 3 if self.silent_failures else int(0 < self.failed == self.n)


def figures(
    sweep: Sweep[R], rows: Sequence[R], command: Callable[[R], str] = lambda _: "", *, wall_s: float = 0.0
) -> Figures:
    """Compute the statistics of rows. `command` returns the command that repeats a row's trial."""
    standings = Counter(sweep.standing(row) for row in rows)
    counted = [row for row in rows if sweep.standing(row) != "uncounted"]
    failures = tuple(_failure(row, command) for row in counted if sweep.standing(row) != "right")
    named = dict.fromkeys(row.condition for row in rows)
    conditions = tuple(
        _of_condition(sweep, name, [row for row in rows if row.condition == name]) for name in named
    )
    total = _of_condition(sweep, "", rows)
    return Figures(
        kind=sweep.kind,
        n=total.n,
        right=total.right,
        silent_failures=standings["silent"],
        failed=sum(row.broken_off for row in rows),
        uncounted=standings["uncounted"],
        killed=sum(row.killed for row in rows),
        wilson95=total.wilson95,
        p_s=total.p_s,
        outcomes=total.outcomes,
        measures=total.measures,
        conditions=conditions if len(conditions) > 1 else (),
        failures=failures,
        causes=_causes(failures),
        cpu_s=round(sum(row.cpu_s for row in rows), 3),
        wall_s=round(wall_s, 3),
    )


def _of_condition(sweep: Sweep[R], name: str, rows: Sequence[R]) -> ConditionFigures:
    counted = [row for row in rows if sweep.standing(row) != "uncounted"]
    right = sum(sweep.standing(row) == "right" for row in counted)
    sure = rate(right, len(counted))
    values: dict[str, list[float]] = {}
    for row in counted:
        for measure, value in row.measures.items():
            values.setdefault(measure, []).append(value)
    return ConditionFigures(
        condition=name,
        n=len(counted),
        right=right,
        outcomes=dict(Counter(row.verdict for row in rows).most_common()),
        wilson95=sure.wilson95,
        p_s=sure.p_s,
        measures={measure: spread(each) for measure, each in values.items()},
    )


def spread(values: Sequence[float]) -> Spread:
    """Return the distribution of one or more values."""
    median, p95, most = np.percentile(values, [50, 95, 100]).round(6).tolist()
    return Spread(n=len(values), median=median, p95=p95, most=most)


def _failure(row: R, command: Callable[[R], str]) -> Failure:
    return Failure(
        trial=row.trial, seed=row.seed, condition=row.condition, verdict=row.verdict, stage=row.stage,
        cause=row.cause, detail=row.detail, line=row.line, command=command(row),
    )  # fmt: skip


def _causes(failures: Sequence[Failure]) -> tuple[Cause, ...]:
    counts = Counter((failure.stage, failure.cause) for failure in failures)
    first = {(failure.stage, failure.cause): failure.command for failure in reversed(failures)}
    return tuple(
        Cause(stage=stage, cause=cause, count=count, command=first[stage, cause])
        for (stage, cause), count in counts.most_common()
    )
