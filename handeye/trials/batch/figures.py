"""Figures of a batch, from its rows."""

from collections import Counter
from collections.abc import Callable, Sequence

from handeye.core.record import Record
from handeye.trials.batch.distributions import (
    Margin,
    SearchPlaces,
    StageTime,
    margins,
    search_places,
    stage_times,
)
from handeye.trials.batch.rates import Rate, rate
from handeye.trials.batch.row import Row, Verdict


class Failure(Record, frozen=True, kw_only=True):
    """A trial that did not end with a right assembly."""

    trial: int
    seed: int
    verdict: Verdict
    stage: str
    cause: str
    """The same words for the same cause."""
    detail: str
    """The same with its figures."""
    line: str | None
    """Of the script, where the program stopped."""
    command: str
    """Carries it out again."""


class Cause(Record, frozen=True, kw_only=True):
    """Failures in the same stage for the same cause."""

    stage: str
    cause: str
    count: int
    command: str
    """Carries the first of them out again."""


class Figures(Record, frozen=True, kw_only=True):
    """What the trials of a batch come to. But for the host's seconds, equal batches have equal figures."""

    n: int
    assembled: int
    silent_failures: int
    """Trials in which the program said done, and the referee disagreed."""
    stopped: int
    """Trials in which the program called the operator."""
    failed: int
    """Trials that broke off: by an exception, at a limit, or because their process was killed twice."""
    killed: int
    """How often the process of a trial was killed."""
    answered: int
    """Trials in which calls of the operator were answered, however they ended: `--on-stop`."""
    wilson95: tuple[float, float] | None
    """Wilson's interval of the probability that a trial is assembled."""
    p_s: float | None
    """Lower bound of the same, 95 % one-sided, exact."""
    failures: tuple[Failure, ...]
    causes: tuple[Cause, ...]
    """Of the failures, the most frequent first."""
    operations: dict[str, Rate]
    """Success of each contact operation: the program went on behind it."""
    stages: tuple[StageTime, ...]
    searches: tuple[SearchPlaces, ...]
    margins: tuple[Margin, ...]
    """To the limits of the referee; the next to fail first."""
    cpu_s: float
    """Of all trials."""
    wall_s: float
    """Of the host, since this command began."""
    real_time_factor: float | None
    """Simulated seconds of the trials that this command carried out, for one of `wall_s`; None: it carried out none."""


def figures(
    rows: Sequence[Row], command: Callable[[Row], str], *, fresh: Sequence[Row] = (), wall_s: float = 0.0
) -> Figures:
    """The figures of some rows.

    Args:
        command: the command that carries a trial out again.
        fresh: rows of trials that were carried out just now, within the `wall_s`.
    """
    counts = Counter(row.verdict for row in rows)
    sure = rate(counts["assembled"], len(rows))
    simulated = sum(_simulated_s(row) for row in fresh)
    failures = failures_of(rows, command, "assembled")
    return Figures(
        n=len(rows),
        assembled=counts["assembled"],
        silent_failures=counts["silent"],
        stopped=counts["stopped"],
        failed=counts["failed"],
        killed=sum(row.killed for row in rows),
        answered=sum(row.result is not None and bool(row.result.interventions) for row in rows),
        wilson95=sure.wilson95,
        p_s=sure.p_s,
        failures=failures,
        causes=causes_of(failures),
        operations=_operations(rows),
        stages=tuple(stage_times(rows)),
        searches=tuple(search_places(rows)),
        margins=margins(rows),
        cpu_s=round(sum(row.cpu_s for row in rows), 3),
        wall_s=round(wall_s, 3),
        real_time_factor=round(simulated / wall_s, 3) if fresh and wall_s > 0 else None,
    )


def failures_of(rows: Sequence[Row], command: Callable[[Row], str], *right: Verdict) -> tuple[Failure, ...]:
    """The trials that did not end as they should.

    Args:
        command: the command that carries a trial out again.
        right: verdicts of those that did.
    """
    return tuple(_failure(row, command) for row in rows if row.verdict not in right)


def _simulated_s(row: Row) -> float:
    return 0.0 if row.result is None else row.result.timing.real_time_factor * row.result.timing.run_wall_s


def _operations(rows: Sequence[Row]) -> dict[str, Rate]:
    done: dict[str, list[bool]] = {}
    for contact in (contact for row in rows for contact in row.contacts):
        done.setdefault(contact.operation, []).append(contact.done)
    return {name: rate(sum(each), len(each)) for name, each in done.items()}


def causes_of(failures: Sequence[Failure]) -> tuple[Cause, ...]:
    """The causes of failures, the most frequent first."""
    counts = Counter((failure.stage, failure.cause) for failure in failures)
    first = {(failure.stage, failure.cause): failure.command for failure in reversed(failures)}
    return tuple(
        Cause(stage=stage, cause=cause, count=count, command=first[stage, cause])
        for (stage, cause), count in counts.most_common()
    )


def _failure(row: Row, command: Callable[[Row], str]) -> Failure:
    return Failure(
        trial=row.trial,
        seed=row.seed,
        verdict=row.verdict,
        stage=row.stage,
        cause=row.cause,
        detail=row.detail,
        line=row.line,
        command=command(row),
    )
