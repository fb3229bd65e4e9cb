"""What two runs found and corrected: differences that were saved, and parts that were seen, one beside the other."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal

import numpy as np

from handeye.comparison.pairing import CarriedOut, Turn, TwoRuns, side_by_side
from handeye.comparison.place import Place
from handeye.core.record import Record
from handeye.program.events import PartSeen, Saved
from handeye.trace.account import ASTRAY


class Correction(Record, frozen=True, kw_only=True):
    """Something that a run found to be elsewhere than was thought."""

    place: Place
    kind: Literal["saved", "seen"]
    name: str
    """Of the difference, or of the part."""
    at: tuple[float, ...]
    """x, y and z of a difference; x and y of a part, m."""
    yaw: float | None = None
    """Of a part, rad; None: a difference, or a general look."""


class Corrections(Record, frozen=True, kw_only=True):
    """The same correction in two runs; None: it did not make it."""

    a: Correction | None
    b: Correction | None

    @property
    def apart(self) -> float | None:
        """How far one is from the other, m; None: there are not both."""
        if self.a is None or self.b is None or len(self.a.at) != len(self.b.at):
            return None
        return float(np.linalg.norm(np.subtract(self.b.at, self.a.at)))

    @property
    def alike(self) -> bool:
        """They are not worth a word apart; or only one was made."""
        return self.apart is None or self.apart <= ASTRAY


def corrections(runs: TwoRuns) -> tuple[Corrections, ...]:
    """The corrections of two runs, in the order of the script."""
    both = (_corrections(steps) for steps in runs.carried_out)
    return tuple(Corrections(a=a, b=b) for a, b in side_by_side(*both))


def _corrections(steps: Sequence[CarriedOut]) -> Mapping[Turn, Correction]:
    return {each.turn: found for each in steps for found in _found(each)}


def _found(each: CarriedOut) -> Iterator[Correction]:
    for event in each.done.events:
        if isinstance(event, Saved):
            yield Correction(place=each.place, kind="saved", name=event.name, at=event.difference)
        elif isinstance(event, PartSeen):
            at = event.x, event.y
            yield Correction(place=each.place, kind="seen", name=event.part, at=at, yaw=event.yaw)
