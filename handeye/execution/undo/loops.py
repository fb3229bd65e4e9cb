"""Rounds of a loop that changed nothing but what the program remembers: they need not be gone back one by one.

Where a program has jumped back to a step at which it was before, it takes the world for what it was then. That is so
if in between nobody was called, the hand holds what it held, whatever it put down it has taken up again at the same
place (or the other way round), and whatever the driver drove in, it has backed out. Rounds that carry things from one
place to another are no such loop, and are undone one by one.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Final

import numpy as np

from handeye.execution.undo.done import Done
from handeye.pose import Array
from handeye.program.guards import GuardKind

SAME_GAP: Final = 5e-4
"""m: the hand holds what it held."""
SAME_PLACE: Final = (0.005, 0.02)
"""m sideways and in height within which a thing is taken up where it was put down: fingers slide on it."""


def loop_entry(done: Sequence[Done], hand: Callable[[int], Array | None]) -> int | None:
    """The index of the step behind which the last one that was executed found the world as it left it, if there is one.

    Args:
        hand: where the hand was when a step, given by its index, had been done, shape (3,), W; None: it never moved.
    """
    last = len(done) - 1
    if last < 1 or done[last - 1].step < done[last].step:  # no jump back has led here
        return None
    for entry, earlier in enumerate(done[:last]):
        if _alike(earlier, done[last]) and _undone_itself(done, entry, hand):
            return entry
    return None


def without_rounds(done: Sequence[Done], hand: Callable[[int], Array | None]) -> Iterator[int]:
    """Indices of the steps as they are undone, the last first, without those of rounds that are left out."""
    index = len(done) - 1
    while index >= 0:
        yield index
        entry = loop_entry(done[: index + 1], hand)
        index = index - 1 if entry is None else entry


def _alike(one: Done, other: Done) -> bool:
    """The same step, begun with the same in the hand, and the driver off."""
    same = (one.step, one.load, one.grasping) == (other.step, other.load, other.grasping)
    return same and one.tool == other.tool == 0.0 and abs(one.gap[0] - other.gap[0]) < SAME_GAP


def _undone_itself(done: Sequence[Done], entry: int, hand: Callable[[int], Array | None]) -> bool:
    """Nothing but memory is another now than when a step was first executed."""
    rounds = range(entry, len(done) - 1)
    if any(done[index].called for index in rounds):
        return False
    driven = sum(done[index].ended is GuardKind.TORQUE for index in rounds)
    backed = sum(done[index].tool < 0 and bool(done[index].way) for index in rounds)
    changes = [index for index in rounds if done[index].grasping != done[index + 1].grasping]
    paired = zip(changes[::2], changes[1::2], strict=False)
    return (
        driven == backed
        and len(changes) % 2 == 0
        and all(_near(hand(one), hand(other)) for one, other in paired)
    )


def _near(one: Array | None, other: Array | None) -> bool:
    if one is None or other is None:
        return one is other
    away = np.abs(one - other)
    aside, height = SAME_PLACE
    return bool(np.hypot(*away[:2]) < aside and away[2] < height)
