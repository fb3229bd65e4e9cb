"""Batches in the same worlds, compared pair by pair."""

from collections.abc import Iterator, Mapping, Sequence
from statistics import median
from typing import NamedTuple

from handeye.core.errors import Refused
from handeye.core.record import Record
from handeye.results.result import Result
from handeye.trials.batch.folder import Head
from handeye.trials.batch.rates import mcnemar, signed_rank
from handeye.trials.batch.row import Row, Verdict

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
    both: int
    """Pairs in which both were assembled."""
    longer_s: float | None
    """Median of how much longer the arm took, over those pairs, by the clock of the cell; None: there are none."""
    p_longer: float | None
    """Two-sided, of Wilcoxon's signed-rank test: how likely such differences are if both take as long."""
    told: int
    """Failures of this batch that the program noticed, by an error or a call."""
    silent: int
    """Failures that it took for success."""
    failed: int
    """Runs of this batch that broke off."""


class Outcome(NamedTuple):
    """What one trial counts as in a comparison."""

    verdict: Verdict
    arm_s: float | None
    """Arm time, of a trial that left a result."""


def paired(names: Sequence[str], batches: Sequence[Batch]) -> tuple[Paired, ...]:
    """Each batch beside the first one.

    Raises:
        InvalidInput: one has no seed in common with the first, or the same seeds are other worlds in it; or what was
            tried in one is not to assemble.
    """
    drawing = batches[0][0].world.drawing
    for name, (head, _) in zip(names, batches, strict=True):
        if head.work:
            raise Refused(f"{name} holds trials of another kind: those that assemble are compared")
        if head.world.drawing != drawing:
            raise Refused(f"{name} was carried out by another version, whose seeds were other worlds")
    first, *others = (_outcomes(rows) for _, rows in batches)
    return tuple(beside(name, first, other) for name, other in zip(names[1:], others, strict=True))


def _outcomes(rows: Sequence[Row]) -> dict[int, Outcome]:
    return {row.seed: Outcome(row.verdict, _arm_s(row.result)) for row in rows}


def _arm_s(result: Result | None) -> float | None:
    return None if result is None else result.timing.manipulation_s


def beside(name: str, first: Mapping[int, Outcome], other: Mapping[int, Outcome]) -> Paired:
    """A batch beside another, trials by their seeds.

    Raises:
        InvalidInput: they have no seed in common.
    """
    pairs = [(first[seed], this) for seed, this in other.items() if seed in first]
    if not pairs:
        raise Refused(f"{name} has no seed in common with the first batch; they are compared pair by pair")
    right = [(one.verdict == "assembled", this.verdict == "assembled") for one, this in pairs]
    only_first, only_this = right.count((True, False)), right.count((False, True))
    counts = [this.verdict for _, this in pairs]
    longer = list(_longer(pairs))
    return Paired(
        name=name,
        pairs=len(pairs),
        assembled=sum(this for _, this in right),
        first_assembled=sum(one for one, _ in right),
        only_first=only_first,
        only_this=only_this,
        p=mcnemar(only_first, only_this),
        both=len(longer),
        longer_s=median(longer) if longer else None,
        p_longer=signed_rank(longer) if longer else None,
        told=counts.count("stopped"),
        silent=counts.count("silent"),
        failed=counts.count("failed"),
    )


def _longer(pairs: Sequence[tuple[Outcome, Outcome]]) -> Iterator[float]:
    """How much longer the arm took in the second of each pair of which both were assembled, s."""
    for one, this in pairs:
        if one.verdict == this.verdict == "assembled" and one.arm_s is not None and this.arm_s is not None:
            yield this.arm_s - one.arm_s
