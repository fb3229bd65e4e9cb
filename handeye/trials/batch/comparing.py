"""Batches in the same worlds, compared pair by pair."""

from collections.abc import Sequence

from handeye.errors import InvalidInput
from handeye.record import Record
from handeye.trials.batch.folder import Head
from handeye.trials.batch.rates import mcnemar
from handeye.trials.batch.row import Row

Batch = tuple[Head, tuple[Row, ...]]


class Paired(Record, frozen=True, kw_only=True):
    """A batch beside the first, over the seeds that both have."""

    name: str
    pairs: int
    assembled: int
    first_assembled: int
    """Of the first batch, over the same seeds."""
    only_first: int
    """Pairs in which only the first was assembled."""
    only_this: int
    p: float
    """Two-sided, of McNemar's exact test: how likely so uneven a split is if neither is better."""
    told: int
    """Failures of this batch that the program noticed, by an error or a call."""
    silent: int
    """Failures that it took for success."""
    failed: int
    """Runs of this batch that broke off."""


def paired(names: Sequence[str], batches: Sequence[Batch]) -> tuple[Paired, ...]:
    """Each batch beside the first one.

    Raises:
        InvalidInput: one has no seed in common with the first.
    """
    first = {row.seed: row for row in batches[0][1]}
    return tuple(_beside(first, name, rows) for name, (_, rows) in zip(names[1:], batches[1:], strict=True))


def _beside(first: dict[int, Row], name: str, rows: Sequence[Row]) -> Paired:
    pairs = [(first[row.seed], row) for row in rows if row.seed in first]
    if not pairs:
        raise InvalidInput(
            f"{name} has no seed in common with the first batch; they are compared pair by pair"
        )
    right = [(one.verdict == "assembled", other.verdict == "assembled") for one, other in pairs]
    only_first, only_this = right.count((True, False)), right.count((False, True))
    counts = [other.verdict for _, other in pairs]
    return Paired(
        name=name,
        pairs=len(pairs),
        assembled=sum(this for _, this in right),
        first_assembled=sum(one for one, _ in right),
        only_first=only_first,
        only_this=only_this,
        p=mcnemar(only_first, only_this),
        told=counts.count("stopped"),
        silent=counts.count("silent"),
        failed=counts.count("failed"),
    )
