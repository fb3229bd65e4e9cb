"""Compares batches of the same kind trial by trial, in the worlds that they have in common."""

from collections.abc import Mapping, Sequence
from statistics import median
from typing import Any, NamedTuple

from handeye.core.errors import Refused
from handeye.core.record import Record
from handeye.trials.figures import mcnemar, signed_rank
from handeye.trials.folder import Head, sweep_of
from handeye.trials.sweep import Standing, TrialRow

Batch = tuple[Head, tuple[Any, ...]]
Key = tuple[str, int, int]  # Condition, seed, and index of the trial in that world


class Difference(Record, frozen=True, kw_only=True):
    """The difference between two batches in a measured value. A pair of trials counts only if both trials succeeded."""

    pairs: int
    more: float  # Median, over the pairs, of the value in this batch minus the value in the first batch
    p: float
    """Two-sided p-value of Wilcoxon's signed-rank test. If neither batch were better, `p` would be the probability of
    differences that favour one batch at least as strongly as the measured differences.
    """


class PairedBatch(Record, frozen=True, kw_only=True):
    """The comparison of a batch with the first batch, over the trials that both contain."""

    name: str
    pairs: int
    right: int
    first_right: int  # Pairs in which the trial of the first batch was right
    only_first: int  # Pairs in which only the first was right
    only_this: int
    p: float  # Two-sided p-value of McNemar's exact test
    measures: dict[str, Difference]
    noticed: int  # Failures of this batch that were noticed: by an error, a call, a guard
    silent: int  # Failures that the program reported as a success
    failed: int  # Trials of this batch that did not finish


class PairedTrial(NamedTuple):
    """The outcome and the measured values of one trial, to be paired with the trial of another batch."""

    standing: Standing
    broken_off: bool
    measures: Mapping[str, float]


def paired(names: Sequence[str], batches: Sequence[Batch]) -> tuple[PairedBatch, ...]:
    """Compare each later batch with the first batch. All batches must be of the same kind. They must also come from
    versions of handeye in which the same seeds give the same worlds. If not, this function raises InvalidInput.
    """
    first_head = batches[0][0]
    for name, (head, _) in zip(names, batches, strict=True):
        if head.kind != first_head.kind:
            raise Refused(f"{name} holds trials of another kind: {head.kind}, not {first_head.kind}")
        if head.world.drawing != first_head.world.drawing:
            raise Refused(
                f"{name} comes from another version of handeye, in which the same seeds give different worlds"
            )
    first, *others = (_trials(head, rows) for head, rows in batches)
    return tuple(beside(name, first, other) for name, other in zip(names[1:], others, strict=True))


def _trials(head: Head, rows: Sequence[TrialRow]) -> dict[Key, PairedTrial]:
    sweep, in_world, found = sweep_of(head.kind), dict[tuple[str, int], int](), dict[Key, PairedTrial]()
    for row in rows:
        world = row.condition, row.seed
        number = in_world[world] = in_world.get(world, -1) + 1
        standing = sweep.standing(row)
        if standing != "uncounted":
            found[*world, number] = PairedTrial(standing, row.broken_off, row.measures)
    return found


def beside(name: str, first: Mapping[Key, PairedTrial], other: Mapping[Key, PairedTrial]) -> PairedBatch:
    """Compare a batch with another. Raises InvalidInput if the batches have no trials in common."""
    pairs = [(first[key], this) for key, this in other.items() if key in first]
    if not pairs:
        raise Refused(
            f"{name} has no seed in common with the first batch; only trials with the same seed can be compared"
        )
    right = [(one.standing == "right", this.standing == "right") for one, this in pairs]
    only_first, only_this = right.count((True, False)), right.count((False, True))
    ended = [this for _, this in pairs if not this.broken_off]
    return PairedBatch(
        name=name,
        pairs=len(pairs),
        right=sum(this for _, this in right),
        first_right=sum(one for one, _ in right),
        only_first=only_first,
        only_this=only_this,
        p=mcnemar(only_first, only_this),
        measures=_differences([pair for pair, both in zip(pairs, right, strict=True) if all(both)]),
        noticed=sum(this.standing == "wrong" for this in ended),
        silent=sum(this.standing == "silent" for this in ended),
        failed=len(pairs) - len(ended),
    )


def _differences(pairs: Sequence[tuple[PairedTrial, PairedTrial]]) -> dict[str, Difference]:
    found: dict[str, list[float]] = {}
    for one, this in pairs:
        for name in one.measures.keys() & this.measures.keys():
            found.setdefault(name, []).append(this.measures[name] - one.measures[name])
    return {
        name: Difference(pairs=len(each), more=median(each), p=signed_rank(each))
        for name, each in sorted(found.items())
    }
