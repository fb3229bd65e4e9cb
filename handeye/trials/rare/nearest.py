"""Finds failing worlds: worlds in which a program fails. Among these, it searches for the worlds whose quantities are
nearest to the middle of their ranges. It also finds the quantities that make the program fail.

A world in which the program fails differs from the middle in every quantity, although only a few quantities matter.
Therefore the search sets quantities of a failing world back to the middle of their ranges: first groups of quantities,
then single quantities. A quantity stays there only if the program still fails. This is delta debugging (A. Zeller and
R. Hildebrandt, Simplifying and isolating failure-inducing input, IEEE Transactions on Software Engineering 28 (2002)
183-200). Then the search reduces all remaining deviations together. The noise stays the same.
"""

from collections import deque
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.core.plain_text import counted
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.trials.rare.campaign import WORLDS, Campaign, Failing, file_of
from handeye.trials.rare.points import Point
from handeye.trials.rare.row import FailureKind, RareRow

HALVINGS: Final = 4  # how often the length of the remaining deviations is halved


class NearWorld(Record, frozen=True, kw_only=True):
    """A world in which the program fails, with as few and as small deviations as the search found."""

    failure: FailureKind
    distance: float  # from the middle of all quantities, in standard deviations
    found_at: float  # distance of the world from which the search began
    quantities: dict[str, float]  # deviations in standard deviations, the greatest first
    seed: int  # of the noise
    detail: str  # why it failed
    file: str  # within the folder of the batch; empty: there is none


class Push(Record, frozen=True, kw_only=True):
    """The mean deviation of one quantity from its middle value, in standard deviations. The mean is over failing
    worlds. The sign of a mean deviation shows whether the program fails mostly at greater or at smaller values of this
    quantity.
    """

    quantity: str
    worlds: int  # how many of the nearest worlds need it
    mean: float | None  # its mean deviation in these worlds; None: no such world needs it
    shift: float  # its mean deviation in all failing worlds of the search


@dataclass(slots=True)
class _Descent:
    """A search for the nearest failing world. The search began at the failing world `begun`."""

    begun: Failing
    tries: Generator[Array, bool, None]
    numbers: Array
    row: RareRow
    candidate: Array | None = None


def nearest(campaign: Campaign, kind: FailureKind, count: int, rounds: int) -> list[NearWorld]:
    """Find nearer failing worlds. There is one search for each of the `count` failing worlds whose errors are
    smallest. The search begins at that world, and makes at most `rounds` runs.
    """
    descents = [_begun(campaign, each, rounds) for each in _chosen(campaign, kind, count)]
    for number in range(rounds):
        active = [each for each in descents if each.candidate is not None]
        if not active:
            break
        points = [
            Point(each.candidate, each.begun.point.noise) for each in active if each.candidate is not None
        ]
        places = [(f"from {file_of(each.begun.row)}, {counted(rounds, 'round')}", number) for each in active]
        rows = campaign.run(places, points, kept=False)
        for each, point, row in zip(active, points, rows, strict=True):
            fails = row.failure == kind
            if fails:
                each.numbers, each.row = point.numbers, row
            each.candidate = _following(each.tries, fails=fails)
    found = sorted(descents, key=lambda each: campaign.space.distance(each.numbers))
    return [_told(campaign, each, number) for number, each in enumerate(found, 1)]


def simplified(numbers: Array, groups: Sequence[Sequence[int]], tries: int) -> Generator[Array, bool, None]:
    """Yield at most `tries` worlds that deviate less from the middle than the failing world does. For each world, the
    caller answers True if the program still fails in it.
    """
    kept = numbers.copy()
    parts = deque(list(group) for group in groups)
    for _ in range(max(0, tries - HALVINGS)):
        if not parts:
            break
        part = parts.popleft()
        tried = kept.copy()
        tried[part] = 0.0
        if (yield tried):
            kept = tried
        elif len(part) > 1:
            half = len(part) // 2
            parts.extend((part[:half], part[half:]))
    low, high = 0.0, 1.0
    for _ in range(min(tries, HALVINGS)):
        middle = (low + high) / 2
        low, high = (low, middle) if (yield kept * middle) else (middle, high)


def pushes(campaign: Campaign, kind: FailureKind, found: Sequence[NearWorld]) -> list[Push]:
    """Return, for each quantity, how far it deviates from its middle value in the failing worlds. The quantities are
    sorted by the number of nearest worlds in which their deviation is needed for the failure, the largest number
    first.
    """
    mine = [each for each in campaign.failing if each.kind == kind]
    if not mine:
        return []
    away = np.mean([campaign.space.deviations(each.point.numbers) for each in mine], axis=0)
    each = [
        Push(
            quantity=name,
            worlds=len(needed := [world.quantities[name] for world in found if name in world.quantities]),
            mean=round(float(np.mean(needed)), 3) if needed else None,
            shift=round(float(shift), 3),
        )
        for name, shift in zip(campaign.space.names, away, strict=True)
    ]
    return sorted(each, key=lambda push: (-push.worlds, -abs(push.mean or 0.0), -abs(push.shift)))


def _chosen(campaign: Campaign, kind: FailureKind, count: int) -> list[Failing]:
    """Return the failing worlds nearest to the middle of all quantities. No two of these worlds have the same noise."""
    mine = [each for each in campaign.failing if each.kind == kind]
    ordered = sorted(mine, key=lambda each: campaign.space.distance(each.point.numbers))
    chosen: dict[int, Failing] = {}
    for each in ordered:
        chosen.setdefault(each.point.noise, each)
    return [*chosen.values()][:count]


def _begun(campaign: Campaign, failing: Failing, rounds: int) -> _Descent:
    tries = simplified(campaign.space.deviations(failing.point.numbers), campaign.space.groups(), rounds)
    return _Descent(failing, tries, failing.point.numbers, failing.row, next(tries, None))


def _following(tries: Generator[Array, bool, None], *, fails: bool) -> Array | None:
    try:
        return tries.send(fails)
    except StopIteration:
        return None


def _told(campaign: Campaign, descent: _Descent, number: int) -> NearWorld:
    space, numbers = campaign.space, descent.numbers
    name = f"nearest-{descent.begun.kind}-{number}.json"
    row = descent.row
    campaign.write(name, row, space.world(Point(numbers, descent.begun.point.noise)))
    return NearWorld(
        failure=descent.begun.kind,
        distance=round(space.distance(numbers), 3),
        found_at=round(space.distance(descent.begun.point.numbers), 3),
        quantities=dict(space.told(numbers, np.flatnonzero(space.deviations(numbers)).tolist())),
        seed=descent.begun.point.noise,
        detail=row.detail,
        file="" if campaign.folder is None else f"{WORLDS}/{name}",
    )
